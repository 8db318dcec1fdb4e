//! A procedural pattern: the thickness drawn at each texel. Kernel `pattern`, twin
//! [`reference::pattern`](crate::reference::pattern).

use super::scalar::{count, single};
use crate::{
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct,
    model::{self, Placement},
    wgsl,
};

gpu_struct! {
    struct Params { width: u32, height: u32, pattern: u32, seed: u32, along: [f32; 2], brush: f32, shapes: u32, first: u32, _pad0: u32, _pad1: u32, _pad2: u32 }
}
gpu_struct! {
    struct Capsule { ends: [f32; 4], radii: [f32; 2], _pad: [f32; 2] }
}

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
        let resources = [Resource::uniform::<Params>("params"), Resource::read::<Capsule>("shapes"), Resource::read_write::<f32>("drawn")];
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::PATTERN, wgsl::ALL, &resources)? })
    }

    /// Draws `pattern` at `placement` into `drawn` `[layer][row][column]`, 0 (bare) to 1, as layer number `layer`, on a plane of
    /// `size` columns and rows that repeats. Not for images, which [`PatternImage`](super::PatternImage) draws.
    ///
    /// # Errors
    /// [`GpuError`] if the adapter is out of memory.
    ///
    /// # Panics
    /// If `drawn` has not that many layers, or the pattern is an image: the caller's bug.
    pub fn record(
        &self, recorder: &mut Recorder<'_>, pattern: model::Pattern, _placement: Placement, size: [u32; 2], drawn: &Buffer<f32>,
        layer: usize,
    ) -> Result<(), GpuError> {
        let [width, height] = size;
        let texels = width as usize * height as usize;
        assert!(drawn.len() >= (layer + 1) * texels, "layers of \"{}\"", drawn.label());
        let gpu = recorder.gpu();
        let shapes: Vec<_> = pattern.shapes().into_iter().map(capsule).collect();
        let brush = if let model::Pattern::Brush { width, .. } = pattern { width } else { 0.0 };
        let params = Params {
            width,
            height,
            pattern: pattern.code(),
            seed: pattern.seed(),
            along: [1.0, 0.0],
            brush: single(brush),
            shapes: count(shapes.len()),
            first: count(layer * texels),
            ..Default::default()
        };
        let params = gpu.uniform("pattern params", &params)?;
        let shapes = gpu.upload("pattern shapes", &shapes)?;
        recorder.dispatch(&self.kernel, &[bind("params", &params), bind("shapes", &shapes), bind("drawn", drawn)], Grid::threads(texels))
    }
}

fn capsule(shape: model::Capsule) -> Capsule {
    let [[x0, y0], [x1, y1]] = [shape.from, shape.to];
    Capsule { ends: [x0, y0, x1, y1].map(single), radii: shape.radii.map(single), _pad: [0.0; 2] }
}
