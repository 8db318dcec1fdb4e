//! Reflectance from radiance (thesis eq. 3.5). Kernel `brdf_values`, twin
//! [`reference::brdf_values`](crate::reference::brdf_values).

use half::f16;

use super::{
    scalar::{count, single},
    tile::Tile,
};
use crate::{
    data::{OCTET, Samples},
    gpu::{Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct, wgsl,
};

gpu_struct! {
    struct Params { texels: u32, octets: u32 }
}

/// The stage's kernel on one device.
#[derive(Debug)]
pub struct BrdfValues {
    kernel: Kernel,
}

impl BrdfValues {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let resources = [
            Resource::uniform::<Params>("params"),
            Resource::read::<[f32; 4]>("inverse_cosines"),
            Resource::read::<[f16; OCTET]>("radiance"),
            Resource::read_write::<[f16; OCTET]>("reflectance"),
        ];
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::BRDF_VALUES, wgsl::ALL, &resources)? })
    }

    /// π·f_r of a tile of radiance in reflectance units. The caller leaves grazing lights out of the tile
    /// ([`FitSettings::min_cos_light`](crate::model::FitSettings::min_cos_light)). Masked samples stay masked.
    ///
    /// # Errors
    /// [`GpuError`] if the result does not fit the adapter.
    pub fn record(&self, recorder: &mut Recorder<'_>, radiance: &Tile, samples: &Samples) -> Result<Tile, GpuError> {
        let gpu = recorder.gpu();
        let (texels, octets) = (radiance.texels, radiance.octets());
        let mut inverse: Vec<f32> = samples.light_cosines().map(|cosine| single(1.0 / cosine)).collect();
        inverse.resize(octets * OCTET, 0.0);
        let inverse = gpu.upload::<[f32; 4]>("inverse cosines", bytemuck::cast_slice(&inverse))?;
        let params = gpu.uniform("brdf_values params", &Params { texels: count(texels), octets: count(octets) })?;
        let values = gpu.fresh("reflectance", 3 * octets * texels)?;
        recorder.dispatch(
            &self.kernel,
            &[bind("params", &params), bind("inverse_cosines", &inverse), bind("radiance", &radiance.values), bind("reflectance", &values)],
            Grid::threads(3 * octets * texels),
        )?;
        Ok(Tile { values, texels, samples: radiance.samples })
    }
}
