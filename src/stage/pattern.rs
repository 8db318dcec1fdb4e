//! A procedural pattern: the thickness drawn at each texel. Kernel `pattern`, twin
//! [`reference::pattern`](crate::reference::pattern).

use super::scalar::{count, single};
use crate::{
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct, model, wgsl,
};

gpu_struct! {
    struct Params { width: u32, height: u32, pattern: u32, seed: u32, along: [f32; 2], brush: f32, shapes: u32 }
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

    /// Drawn thickness `[row][column]`, 0 (bare) to 1, of a plane of `size` columns and rows that repeats.
    ///
    /// # Errors
    /// [`GpuError`] if the result does not fit the adapter.
    pub fn record(&self, recorder: &mut Recorder<'_>, pattern: model::Pattern, size: [u32; 2]) -> Result<Buffer<f32>, GpuError> {
        let [width, height] = size;
        let texels = width as usize * height as usize;
        let gpu = recorder.gpu();
        let shapes: Vec<_> = pattern.shapes().into_iter().map(capsule).collect();
        let (angle, brush) = match pattern {
            model::Pattern::Brush { angle, width, .. } => (angle, width),
            model::Pattern::Uniform | model::Pattern::Splash { .. } => (0.0, 0.0),
        };
        let params = Params {
            width,
            height,
            pattern: pattern.code(),
            seed: pattern.seed(),
            along: [angle.cos(), angle.sin()].map(single),
            brush: single(brush),
            shapes: count(shapes.len()),
        };
        let params = gpu.uniform("pattern params", &params)?;
        let shapes = gpu.upload("pattern shapes", &shapes)?;
        let drawn = gpu.fresh("drawn", texels)?;
        recorder.dispatch(
            &self.kernel,
            &[bind("params", &params), bind("shapes", &shapes), bind("drawn", &drawn)],
            Grid::threads(texels),
        )?;
        Ok(drawn)
    }
}

fn capsule(shape: model::Capsule) -> Capsule {
    let [[x0, y0], [x1, y1]] = [shape.from, shape.to];
    Capsule { ends: [x0, y0, x1, y1].map(single), radii: shape.radii.map(single), _pad: [0.0; 2] }
}
