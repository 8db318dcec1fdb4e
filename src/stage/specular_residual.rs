//! What the lobe is fitted to: the mean over the channels of max(f − ρ_d, 0). Kernel `specular_residual`, twin
//! [`reference::specular_residual`](crate::reference::specular_residual).

use half::f16;

use super::{scalar::count, tile::Tile};
use crate::{
    data::OCTET,
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct, wgsl,
};

gpu_struct! {
    struct Params { texels: u32, octets: u32, samples: u32, _pad: u32 }
}

/// The stage's kernel on one device.
#[derive(Debug)]
pub struct SpecularResidual {
    kernel: Kernel,
}

impl SpecularResidual {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let resources = [
            Resource::uniform::<Params>("params"),
            Resource::read::<[f16; OCTET]>("reflectance"),
            Resource::read::<[f32; 4]>("diffuse"),
            Resource::read_write::<[f16; OCTET]>("residual"),
        ];
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::SPECULAR_RESIDUAL, wgsl::ALL, &resources)? })
    }

    /// The mean residual `[octet][texel]` of a tile of reflectance above `diffuse` `[texel]`, −1 where masked.
    ///
    /// # Errors
    /// [`GpuError`] if the result does not fit the adapter.
    pub fn record(
        &self, recorder: &mut Recorder<'_>, reflectance: &Tile, diffuse: &Buffer<[f32; 4]>,
    ) -> Result<Buffer<[f16; OCTET]>, GpuError> {
        let gpu = recorder.gpu();
        let (texels, octets) = (reflectance.texels, reflectance.octets());
        let params = Params { texels: count(texels), octets: count(octets), samples: count(reflectance.samples), _pad: 0 };
        let params = gpu.uniform("specular_residual params", &params)?;
        let residual = gpu.fresh("specular residual", octets * texels)?;
        recorder.dispatch(
            &self.kernel,
            &[bind("params", &params), bind("reflectance", &reflectance.values), bind("diffuse", diffuse), bind("residual", &residual)],
            Grid::threads(octets * texels),
        )?;
        Ok(residual)
    }
}
