//! Paint taken for a colour: what painting is without optics, for comparison. Kernel `alpha_blend`, twin
//! [`reference::alpha_blend`](crate::reference::alpha_blend).

use super::scalar::{count, single};
use crate::{
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct,
    model::Layer,
    wgsl,
};

gpu_struct! {
    struct Params { texels: u32, layers: u32, _pad: [u32; 2] }
}

/// The stage's kernel on one device.
#[derive(Debug)]
pub struct AlphaBlend {
    kernel: Kernel,
}

impl AlphaBlend {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let resources = [
            Resource::uniform::<Params>("params"),
            Resource::read::<[f32; 4]>("colours"),
            Resource::read::<f32>("drawn"),
            Resource::read_write::<[f32; 4]>("painted"),
        ];
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::ALPHA_BLEND, wgsl::ALL, &resources)? })
    }

    /// Mixes [`Layer::colour`] of `layers`, from the bottom up, into `painted` `[texel]` (colour of what is covered, and in the fourth
    /// component how much of the texel that is), each by its drawn thickness in `drawn` `[layer][texel]` (0 to 1). Coverage becomes
    /// 1 − Π(1 − drawn).
    ///
    /// # Errors
    /// [`GpuError`] if the adapter is out of memory.
    ///
    /// # Panics
    /// If `drawn` has too few layers: the caller's bug.
    pub fn record(
        &self, recorder: &mut Recorder<'_>, painted: &Buffer<[f32; 4]>, drawn: &Buffer<f32>, layers: &[Layer],
    ) -> Result<(), GpuError> {
        let gpu = recorder.gpu();
        let texels = painted.len();
        assert!(drawn.len() >= layers.len() * texels, "layers of \"{}\"", drawn.label());
        let colour = |layer: &Layer| {
            let [r, g, b] = layer.colour().map(single);
            [r, g, b, 0.0]
        };
        let colours: Vec<[f32; 4]> = layers.iter().map(colour).collect();
        let params = gpu.uniform("alpha_blend params", &Params { texels: count(texels), layers: count(layers.len()), _pad: [0; 2] })?;
        let colours = gpu.upload("colours", &colours)?;
        let binds = [bind("params", &params), bind("colours", &colours), bind("drawn", drawn), bind("painted", painted)];
        recorder.dispatch(&self.kernel, &binds, Grid::threads(texels))
    }
}
