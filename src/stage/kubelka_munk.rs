//! One layer of paint over a ground's diffuse reflectance (thesis eqs. 3.7, 3.9). Kernel `kubelka_munk`, twin
//! [`reference::kubelka_munk`](crate::reference::kubelka_munk).
//!
//! Layers are recorded from the bottom up, the result of one being the ground of the next.

use super::scalar::{count, single};
use crate::{
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct,
    model::Layer,
    wgsl,
};

gpu_struct! {
    struct Params { absorption: [f32; 4], scattering: [f32; 4], closed: f32, texels: u32, _pad: [u32; 2] }
}

/// The stage's kernel on one device.
#[derive(Debug)]
pub struct KubelkaMunk {
    kernel: Kernel,
}

impl KubelkaMunk {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let resources = [
            Resource::uniform::<Params>("params"),
            Resource::read::<[f32; 4]>("ground"),
            Resource::read::<f32>("drawn"),
            Resource::read_write::<[f32; 4]>("painted"),
        ];
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::KUBELKA_MUNK, wgsl::ALL, &resources)? })
    }

    /// `ground` `[texel]` under one `layer` of the thickness `drawn` `[texel]` (0 to 1). In both `[texel]` results and grounds,
    /// rgb is ρ_d and the fourth component the coverage of paint: 0 on bare material, and 1 − Π(1 − smoothstep(0,
    /// [`Layer::CLOSED`], drawn)) over the layers laid so far.
    ///
    /// # Errors
    /// [`GpuError`] if the result does not fit the adapter.
    ///
    /// # Panics
    /// If `ground` and `drawn` differ in length: the caller's bug.
    pub fn record(
        &self, recorder: &mut Recorder<'_>, ground: &Buffer<[f32; 4]>, drawn: &Buffer<f32>, layer: &Layer,
    ) -> Result<Buffer<[f32; 4]>, GpuError> {
        let gpu = recorder.gpu();
        let texels = ground.len();
        assert_eq!(drawn.len(), texels, "texels of \"{}\" and \"{}\"", drawn.label(), ground.label());
        let at_full = |coefficients: [f64; 3]| {
            let [r, g, b] = coefficients.map(|coefficient| single(coefficient * layer.thickness));
            [r, g, b, 0.0]
        };
        let params = Params {
            absorption: at_full(layer.paint.k),
            scattering: at_full(layer.paint.s),
            closed: single(Layer::CLOSED),
            texels: count(texels),
            _pad: [0; 2],
        };
        let params = gpu.uniform("kubelka_munk params", &params)?;
        let painted = gpu.fresh("painted", texels)?;
        let binds = [bind("params", &params), bind("ground", ground), bind("drawn", drawn), bind("painted", &painted)];
        recorder.dispatch(&self.kernel, &binds, Grid::threads(texels))?;
        Ok(painted)
    }
}
