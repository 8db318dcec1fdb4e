//! How far each texel's reflectance, in the frames of its normals, is from the measured radiance. Kernel `radiance_error`, twin
//! [`reference::radiance_error`](crate::reference::radiance_error).

use half::f16;

use super::{
    local_samples::LocalSamples,
    scalar::count,
    tile::{SampleDirections, Tile},
};
use crate::{
    data::OCTET,
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct, wgsl,
};

gpu_struct! {
    struct Params { texels: u32, octets: u32, lobes: u32, _pad: u32 }
}

/// The stage's kernel on one device.
#[derive(Debug)]
pub struct RadianceError {
    kernel: Kernel,
}

impl RadianceError {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let mut resources = vec![Resource::uniform::<Params>("params")];
        resources.extend(LocalSamples::resources());
        resources.extend(["diffuse", "specular"].map(Resource::read::<[f32; 4]>));
        resources.push(Resource::read_write::<[f32; 4]>("errors"));
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::RADIANCE_ERROR, wgsl::ALL, &resources)? })
    }

    /// `[texel]` the sums of (model − L)², L², model − L and L over the samples that are not masked and the channels, L the `radiance`
    /// and model = c·(ρ_d + Σ_j ρ_s,j m_j), with ρ_d = `diffuse` `[texel]` and ρ_s = `specular` `[lobe][texel]`; the rest as in
    /// [`LinearRefit::record`](super::LinearRefit::record). Unlit samples, whose model is 0, count too.
    ///
    /// # Errors
    /// [`GpuError`] if the result does not fit the adapter.
    #[expect(clippy::too_many_arguments, reason = "the model is a function of eight maps, which come from as many stages")]
    pub fn record(
        &self, recorder: &mut Recorder<'_>, radiance: &Tile, shading: &Buffer<[f16; OCTET]>, directions: &Buffer<SampleDirections>,
        normals: &Buffer<[f32; 4]>, diffuse: &Buffer<[f32; 4]>, specular: &Buffer<[f32; 4]>, lobes: &Buffer<[f32; 4]>,
    ) -> Result<Buffer<[f32; 4]>, GpuError> {
        let gpu = recorder.gpu();
        let samples = LocalSamples { radiance, shading, directions, normals, lobes };
        let params =
            Params { texels: count(radiance.texels), octets: count(radiance.octets()), lobes: count(samples.lobe_count()), _pad: 0 };
        let params = gpu.uniform("radiance_error params", &params)?;
        let errors = gpu.fresh("radiance errors", radiance.texels)?;
        let mut binds = vec![bind("params", &params), bind("diffuse", diffuse), bind("specular", specular), bind("errors", &errors)];
        binds.extend(samples.binds());
        recorder.dispatch(&self.kernel, &binds, Grid::threads(radiance.texels))?;
        Ok(errors)
    }
}
