//! ρ_s per channel once the lobe is known (thesis eq. 3.6). Kernel `specular_scale`, twin
//! [`reference::specular_scale`](crate::reference::specular_scale).
//!
//! The thesis takes the mean of s/lobe, which the samples with the smallest lobes dominate. The least-squares ratio is the
//! factor with the smallest squared error there is, so it is the default.

use half::f16;

use super::{
    scalar::{count, single},
    tile::{Tile, upload_products},
};
use crate::{
    data::{OCTET, Samples},
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct,
    model::{FitSettings, SpecularScale as Rule},
    wgsl,
};

gpu_struct! {
    struct Params { texels: u32, octets: u32, rule: u32, min_lobe: f32 }
}

/// The stage's kernel on one device.
#[derive(Debug)]
pub struct SpecularScale {
    kernel: Kernel,
}

impl SpecularScale {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let resources = [
            Resource::uniform::<Params>("params"),
            Resource::read::<[f32; 4]>("products"),
            Resource::read::<[f16; OCTET]>("reflectance"),
            Resource::read::<[f32; 4]>("diffuse"),
            Resource::read::<[f32; 4]>("lobes"),
            Resource::read_write::<[f32; 4]>("specular"),
        ];
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::SPECULAR_SCALE, wgsl::ALL, &resources)? })
    }

    /// ρ_s `[texel]`, one channel a component and 0 in the fourth, from a tile of reflectance, ρ_d `[texel]` and lobes `[texel]`
    /// (C_x, C_y, C_z, n). Masked samples are left out; without a lobe ρ_s is 0.
    ///
    /// # Errors
    /// [`GpuError`] if the result does not fit the adapter.
    pub fn record(
        &self, recorder: &mut Recorder<'_>, reflectance: &Tile, samples: &Samples, diffuse: &Buffer<[f32; 4]>, lobes: &Buffer<[f32; 4]>,
        settings: &FitSettings,
    ) -> Result<Buffer<[f32; 4]>, GpuError> {
        let gpu = recorder.gpu();
        let params = Params {
            texels: count(reflectance.texels),
            octets: count(reflectance.octets()),
            rule: match settings.specular_scale {
                Rule::LeastSquares => 0,
                Rule::MeanRatio => 1,
            },
            min_lobe: single(settings.min_lobe),
        };
        let params = gpu.uniform("specular_scale params", &params)?;
        let products = upload_products(gpu, samples)?;
        let specular = gpu.fresh("specular", reflectance.texels)?;
        recorder.dispatch(
            &self.kernel,
            &[
                bind("params", &params),
                bind("products", &products),
                bind("reflectance", &reflectance.values),
                bind("diffuse", diffuse),
                bind("lobes", lobes),
                bind("specular", &specular),
            ],
            Grid::threads(reflectance.texels),
        )?;
        Ok(specular)
    }
}
