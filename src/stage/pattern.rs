//! A procedural pattern: the thickness drawn at each texel. Kernel `pattern`, twin
//! [`reference::pattern`](crate::reference::pattern).
//!
//! The shapes of a splash are sorted into square bins, so that a texel looks only at those that reach it. This changes nothing: beyond
//! a distance of `FLOW` from its outline a shape adds an exact zero, and each bin keeps the order of its shapes.

use super::scalar::{count, single};
use crate::{
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct,
    model::{self, Placement},
    wgsl,
};

gpu_struct! {
    struct Params {
        size: [u32; 2], cell: [f32; 2], edges: [f32; 2], offset: [f32; 2], turn: [f32; 2], scale: f32, texel: f32, repeats: [u32; 2],
        lattice: [u32; 2], wave: [f32; 2], pattern: u32, seed: u32, petals: u32, amount: f32, first: u32, _pad: u32,
    }
}
gpu_struct! {
    struct Capsule { ends: [f32; 4], radii: [f32; 2], _pad: [f32; 2] }
}

/// As in the kernel: where splash, flower and brush stroke end, pattern coordinates.
const REACH: f64 = 0.52;
/// As in the kernel: bins along each edge of the square from -0.5 to 0.5, and the distance at which a shape ends having a part.
const SPLASH_BINS: u32 = 16;
const FLOW: f64 = 0.05;

/// The stage's kernel on one device.
#[derive(Debug)]
pub struct Pattern {
    kernel: Kernel,
}

impl Pattern {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let resources = [
            Resource::uniform::<Params>("params"),
            Resource::read::<u32>("bins"),
            Resource::read::<Capsule>("shapes"),
            Resource::read_write::<f32>("drawn"),
        ];
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::PATTERN, wgsl::ALL, &resources)? })
    }

    /// Draws `pattern` at `placement` into `drawn` `[layer][row][column]`, 0 (bare) to 1, as layer number `layer`, on a plane of
    /// `size` columns and rows that repeats. Not for images, which [`PatternImage`](super::PatternImage) draws.
    ///
    /// Nothing is drawn finer than a texel: edges are widened to one, and what is thinner fades into its mean. A cell of less than a
    /// few texels shows samples of the pattern.
    ///
    /// # Errors
    /// [`GpuError`] if the adapter is out of memory.
    ///
    /// # Panics
    /// If `drawn` has not that many layers, or the pattern is an image: the caller's bug.
    pub fn record(
        &self, recorder: &mut Recorder<'_>, pattern: model::Pattern, placement: Placement, size: [u32; 2], drawn: &Buffer<f32>,
        layer: usize,
    ) -> Result<(), GpuError> {
        let texels = size[0] as usize * size[1] as usize;
        assert!(drawn.len() >= (layer + 1) * texels, "layers of \"{}\"", drawn.label());
        let gpu = recorder.gpu();
        let (cell, edges) = (placement.cell(size), placement.edges(size));
        // A texel as wide as the pattern's features is wide enough to average them.
        let texel = (1.0 / (cell[0].min(cell[1]) * placement.size)).min(0.25);
        let mut params = Params {
            size,
            cell: cell.map(single),
            edges: edges.map(single),
            offset: [0, 1].map(|axis| single(placement.offset[axis] % edges[axis])),
            turn: placement.turn().map(single),
            scale: single(placement.size),
            texel: single(texel),
            pattern: pattern.code(),
            seed: pattern.seed(),
            first: count(layer * texels),
            ..Default::default()
        };
        match pattern {
            model::Pattern::Uniform { drawn } => params.amount = single(drawn),
            model::Pattern::Splash { .. } => params.repeats = repeats(placement, edges, texel),
            model::Pattern::Flower { petals, .. } => {
                params.repeats = repeats(placement, edges, texel);
                params.petals = petals;
            }
            model::Pattern::Brush { width, .. } => {
                params.repeats = repeats(placement, edges, texel);
                params.amount = single(width);
            }
            model::Pattern::Spatter { cover, .. } => {
                params.lattice = placement.lattice(model::Pattern::SPATTER_LATTICE, size);
                params.amount = single(cover);
            }
            model::Pattern::Stripes { count, width } => {
                params.wave = placement.wave(count, size).map(single);
                params.amount = single(width);
            }
            // A cloud and the gap beside it are two points of the lattice.
            model::Pattern::Noise { count, .. } => params.lattice = placement.lattice(2 * count, size),
            model::Pattern::Image { .. } => panic!("an image is drawn by another stage"),
        }
        let (bins, shapes) = binned(&pattern.shapes());
        let params = gpu.uniform("pattern params", &params)?;
        let bins = gpu.upload("pattern bins", &bins)?;
        let shapes = gpu.upload("pattern shapes", &shapes)?;
        let binds = [bind("params", &params), bind("bins", &bins), bind("shapes", &shapes), bind("drawn", drawn)];
        recorder.dispatch(&self.kernel, &binds, Grid::threads(texels))
    }
}

/// How many repetitions of a pattern, to either side of the nearest, may reach a place.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 3: sizes end at 4, and a texel counts as 0.25 at most")]
fn repeats(placement: Placement, edges: [f64; 2], texel: f64) -> [u32; 2] {
    edges.map(|edge| ((REACH + texel) * placement.size / edge - 0.5).ceil().max(0.0) as u32)
}

/// The shapes that may reach each bin, bin after bin, and where each bin begins; one more number tells where the last one ends.
fn binned(shapes: &[model::Capsule]) -> (Vec<u32>, Vec<Capsule>) {
    let width = 1.0 / f64::from(SPLASH_BINS);
    let from_middle = 0.5 * width * std::f64::consts::SQRT_2;
    let (mut bins, mut sorted) = (vec![0], Vec::new());
    for bin in 0..SPLASH_BINS * SPLASH_BINS {
        let middle = [bin % SPLASH_BINS, bin / SPLASH_BINS].map(|index| (f64::from(index) + 0.5) * width - 0.5);
        // A margin for the rounding of kernels.
        let near = |shape: &&model::Capsule| shape.at_least_apart(middle) < FLOW + from_middle + 1e-4;
        sorted.extend(shapes.iter().filter(near).copied().map(capsule));
        bins.push(count(sorted.len()));
    }
    (bins, sorted)
}

fn capsule(shape: model::Capsule) -> Capsule {
    let [[x0, y0], [x1, y1]] = [shape.from, shape.to];
    Capsule { ends: [x0, y0, x1, y1].map(single), radii: shape.radii.map(single), _pad: [0.0; 2] }
}
