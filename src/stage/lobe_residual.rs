//! What is left for the next lobe to explain. Kernel `lobe_residual`, twin
//! [`reference::lobe_residual`](crate::reference::lobe_residual).
//!
//! Lobes are found one after the other: each is fitted to what the ones before leave, and then all coefficients are found anew by
//! [`LinearRefit`](super::LinearRefit) (orthogonal matching pursuit: Pati, Rezaiifar, Krishnaprasad 1993). Going over all lobes again, each
//! against the rest, changed the relative RMS of the path-traced sets by less than 0.001.

use half::f16;

use super::{Refitted, scalar::count, shading::Shaded, tile::SampleDirections};
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
pub struct LobeResidual {
    kernel: Kernel,
}

impl LobeResidual {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let resources = [
            Resource::uniform::<Params>("params"),
            Resource::read::<SampleDirections>("directions"),
            Resource::read::<[f32; 4]>("seen_normals"),
            Resource::read::<[f16; OCTET]>("shading"),
            Resource::read::<[f16; OCTET]>("means"),
            Resource::read::<[f32; 4]>("diffuse"),
            Resource::read::<[f32; 4]>("specular"),
            Resource::read::<[f32; 4]>("lobes"),
            Resource::read_write::<[f16; OCTET]>("residual"),
        ];
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::LOBE_RESIDUAL, wgsl::ALL, &resources)? })
    }

    /// The residual `[octet][texel]` of the mean radiance in `shaded` under `lobes` `[lobe][texel]` with the coefficients `refitted`, for
    /// samples with the given `directions` and `normals` `[row][texel]`.
    ///
    /// # Errors
    /// [`GpuError`] if the result does not fit the adapter.
    pub fn record(
        &self, recorder: &mut Recorder<'_>, shaded: &Shaded, directions: &Buffer<SampleDirections>, normals: &Buffer<[f32; 4]>,
        lobes: &Buffer<[f32; 4]>, refitted: &Refitted,
    ) -> Result<Buffer<[f16; OCTET]>, GpuError> {
        let gpu = recorder.gpu();
        let texels = refitted.diffuse.len();
        let octets = shaded.shading.len() / texels;
        let params = Params { texels: count(texels), octets: count(octets), lobes: count(lobes.len() / texels), _pad: 0 };
        let params = gpu.uniform("lobe_residual params", &params)?;
        let residual = gpu.fresh("lobe residual", octets * texels)?;
        let binds = [
            bind("params", &params),
            bind("directions", directions),
            bind("seen_normals", normals),
            bind("shading", &shaded.shading),
            bind("means", &shaded.means),
            bind("diffuse", &refitted.diffuse),
            bind("specular", &refitted.specular),
            bind("lobes", lobes),
            bind("residual", &residual),
        ];
        recorder.dispatch(&self.kernel, &binds, Grid::threads(octets * texels))?;
        Ok(residual)
    }
}
