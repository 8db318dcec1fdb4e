//! One layer of paint raises the surface by its thickness. Kernel `paint_relief`, twin
//! [`reference::paint_relief`](crate::reference::paint_relief).

use super::scalar::{count, single};
use crate::{
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct,
    model::Layer,
    wgsl,
};

gpu_struct! {
    struct Params { relief: f32, texels: u32, _pad: [u32; 2] }
}

/// The stage's kernel on one device.
#[derive(Debug)]
pub struct PaintRelief {
    kernel: Kernel,
}

impl PaintRelief {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let resources = [
            Resource::uniform::<Params>("params"),
            Resource::read::<f32>("ground"),
            Resource::read::<f32>("drawn"),
            Resource::read_write::<f32>("heights"),
        ];
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::PAINT_RELIEF, wgsl::ALL, &resources)? })
    }

    /// Heights `[texel]` of the `ground` `[texel]`, both in texel widths, under one `layer` of the thickness `drawn`
    /// `[texel]` (0 to 1).
    ///
    /// # Errors
    /// [`GpuError`] if the result does not fit the adapter.
    ///
    /// # Panics
    /// If `ground` and `drawn` differ in length: the caller's bug.
    pub fn record(
        &self, recorder: &mut Recorder<'_>, ground: &Buffer<f32>, drawn: &Buffer<f32>, layer: &Layer,
    ) -> Result<Buffer<f32>, GpuError> {
        let gpu = recorder.gpu();
        let texels = ground.len();
        assert_eq!(drawn.len(), texels, "texels of \"{}\" and \"{}\"", drawn.label(), ground.label());
        let params = gpu.uniform("paint_relief params", &Params { relief: single(layer.relief), texels: count(texels), _pad: [0; 2] })?;
        let heights = gpu.fresh("painted heights", texels)?;
        let binds = [bind("params", &params), bind("ground", ground), bind("drawn", drawn), bind("heights", &heights)];
        recorder.dispatch(&self.kernel, &binds, Grid::threads(texels))?;
        Ok(heights)
    }
}
