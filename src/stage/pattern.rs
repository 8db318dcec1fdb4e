//! A procedural pattern: the thickness drawn at each texel. Kernels `pattern_brush`, `pattern_flower`, `pattern_noise`,
//! `pattern_spatter`, `pattern_splash`, `pattern_stripes` and `pattern_uniform`, twin
//! [`reference::pattern`](crate::reference::pattern()).
//!
//! The shapes of a splash are sorted into square bins, so that a texel looks only at those that reach it. This changes nothing: at
//! `FLOW` from its outline and beyond a shape adds exactly zero, and each bin keeps the order of its shapes.

use std::f64::consts::SQRT_2;

use super::scalar::{count, single};
use crate::{
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, Source, bind},
    gpu_struct,
    model::{self, Placement},
    wgsl,
};

gpu_struct! {
    struct Params {
        size: [u32; 2], cell: [f32; 2], edges: [f32; 2], offset: [f32; 2], turn: [f32; 2], scale: f32, texel: f32, repeats: [u32; 2],
        lattice: [u32; 2], wave: [f32; 2], seed: u32, petals: u32, amount: f32, first: u32,
    }
}
gpu_struct! {
    struct Capsule { ends: [f32; 4], radii: [f32; 2], _pad: [f32; 2] }
}

/// As in `pattern_plane`: distance from its middle at which a pattern that does not fill its cell ends, pattern coordinates.
const REACH: f64 = 0.49;
/// As in `pattern_splash`: bins along each edge of the square from -0.5 to 0.5, and the distance at which a shape ends having a part.
const BINS: u32 = 16;
const FLOW: f64 = 0.05;

/// The stage's kernels on one device.
#[derive(Debug)]
pub struct Pattern {
    brush: Kernel,
    flower: Kernel,
    noise: Kernel,
    spatter: Kernel,
    splash: Kernel,
    stripes: Kernel,
    uniform: Kernel,
}

impl Pattern {
    /// Builds the kernels.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses one.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let build = |source: &Source, shapes: &[Resource]| {
            let resources = [&[Resource::uniform::<Params>("params"), Resource::read_write::<f32>("drawn")], shapes].concat();
            Kernel::new(gpu, source, wgsl::ALL, &resources)
        };
        Ok(Self {
            brush: build(&wgsl::PATTERN_BRUSH, &[])?,
            flower: build(&wgsl::PATTERN_FLOWER, &[])?,
            noise: build(&wgsl::PATTERN_NOISE, &[])?,
            spatter: build(&wgsl::PATTERN_SPATTER, &[])?,
            splash: build(&wgsl::PATTERN_SPLASH, &[Resource::read::<u32>("bins"), Resource::read::<Capsule>("shapes")])?,
            stripes: build(&wgsl::PATTERN_STRIPES, &[])?,
            uniform: build(&wgsl::PATTERN_UNIFORM, &[])?,
        })
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
        let params = Params { seed: pattern.seed(), first: count(layer * texels), ..placed(placement, size) };
        let (kernel, params) = match pattern {
            model::Pattern::Uniform { drawn } => (&self.uniform, Params { amount: single(drawn), ..params }),
            model::Pattern::Splash { .. } => (&self.splash, params),
            model::Pattern::Flower { petals, .. } => (&self.flower, Params { petals, ..params }),
            model::Pattern::Brush { width, .. } => (&self.brush, Params { amount: single(width), ..params }),
            model::Pattern::Spatter { cover, .. } => {
                let lattice = placement.lattice(model::Pattern::SPATTER_LATTICE, size);
                (&self.spatter, Params { lattice, amount: single(cover), ..params })
            }
            model::Pattern::Stripes { count, width } => {
                (&self.stripes, Params { wave: placement.wave(count, size).map(single), amount: single(width), ..params })
            }
            // A cloud and the gap beside it are two points of the lattice.
            model::Pattern::Noise { count, .. } => (&self.noise, Params { lattice: placement.lattice(2 * count, size), ..params }),
            model::Pattern::Image { .. } => panic!("images are drawn by stage::PatternImage"),
        };
        let params = gpu.uniform("pattern params", &params)?;
        let mut binds = vec![bind("params", &params), bind("drawn", drawn)];
        let (bins, shapes);
        if let model::Pattern::Splash { .. } = pattern {
            let (offsets, sorted) = binned(&pattern.shapes());
            (bins, shapes) = (gpu.upload("splash bins", &offsets)?, gpu.upload("splash shapes", &sorted)?);
            binds.extend([bind("bins", &bins), bind("shapes", &shapes)]);
        }
        recorder.dispatch(kernel, &binds, Grid::threads(texels))
    }
}

/// The parameters that tell where a pattern is drawn.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 2 repetitions: sizes end at 4, texels at 0.25")]
fn placed(placement: Placement, size: [u32; 2]) -> Params {
    let (cell, edges) = (placement.cell(size), placement.edges(size));
    // A texel that is a quarter of the pattern has nothing left to average.
    let texel = (1.0 / (cell[0].min(cell[1]) * placement.size)).min(0.25);
    Params {
        size,
        cell: cell.map(single),
        edges: edges.map(single),
        offset: [0, 1].map(|axis| single(placement.offset[axis] % edges[axis])),
        turn: placement.turn().map(single),
        scale: single(placement.size),
        texel: single(texel),
        // From the nearest repetition on, its middle at most half an edge away.
        repeats: edges.map(|edge| ((REACH + 0.75 * texel) * placement.size / edge - 0.5).ceil().max(0.0) as u32),
        ..Default::default()
    }
}

/// The shapes that may reach each bin, bin after bin, and where each bin begins; one more number tells where the last one ends.
fn binned(shapes: &[model::Capsule]) -> (Vec<u32>, Vec<Capsule>) {
    let width = 1.0 / f64::from(BINS);
    let (mut bins, mut sorted) = (vec![0], Vec::new());
    for bin in 0..BINS * BINS {
        let middle = [bin % BINS, bin / BINS].map(|index| (f64::from(index) + 0.5) * width - 0.5);
        // Half a bin's diagonal from its middle, and a margin for the rounding of kernels.
        let near = |shape: &&model::Capsule| shape.least_distance(middle) < FLOW + 0.5 * SQRT_2 * width + 1e-4;
        sorted.extend(shapes.iter().filter(near).copied().map(capsule));
        bins.push(count(sorted.len()));
    }
    (bins, sorted)
}

fn capsule(shape: model::Capsule) -> Capsule {
    let [[x0, y0], [x1, y1]] = [shape.from, shape.to];
    Capsule { ends: [x0, y0, x1, y1].map(single), radii: shape.radii.map(single), _pad: [0.0; 2] }
}
