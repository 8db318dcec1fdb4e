//! ρ_d and ρ_s per channel by non-negative least squares on the radiance itself, the lobes being known (Lawson and Hanson 1974).
//! Kernel `linear_refit`, twin [`reference::linear_refit`](crate::reference::linear_refit).
//!
//! A quantile of the reflectance underestimates ρ_d: with the mean of what is left over going into no lobe, the material comes out
//! darker than it was measured. Once the lobes are known, the radiance is linear in what remains, and its best fit is found exactly.

use half::f16;

use super::{
    local_samples::LocalSamples,
    scalar::{count, single},
    tile::{SampleDirections, Tile},
};
use crate::{
    data::OCTET,
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct,
    model::MIN_LOBE_ENERGY,
    wgsl,
};

gpu_struct! {
    struct Params { texels: u32, octets: u32, lobes: u32, min_energy: f32 }
}

/// The linear part of a tile's reflectance, one channel a component and 0 in the fourth.
#[derive(Debug)]
pub struct Refitted {
    /// `[texel]` ρ_d, at least 0.
    pub diffuse: Buffer<[f32; 4]>,
    /// `[lobe][texel]` ρ_s, at least 0.
    pub specular: Buffer<[f32; 4]>,
}

/// The stage's kernel on one device.
#[derive(Debug)]
pub struct LinearRefit {
    kernel: Kernel,
}

impl LinearRefit {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let mut resources = vec![Resource::uniform::<Params>("params")];
        resources.extend(LocalSamples::resources());
        resources.extend(["diffuse", "specular"].map(Resource::read_write::<[f32; 4]>));
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::LINEAR_REFIT, wgsl::ALL, &resources)? })
    }

    /// The ρ_d and ρ_s ≥ 0 that minimise Σ (L − c·(ρ_d + Σ_j ρ_s,j m_j))² over a texel's lit samples, per channel: L the `radiance`,
    /// c the `shading` `[octet][texel]` (cos θ_i against the sample's normal times the share of the light that reaches the point;
    /// 0 where masked or unlit and past the last sample) and m_j lobe j, of `lobes` `[lobe][texel]` (C_x, C_y, C_z, n), in the
    /// frame of that normal. A sample's normal is that of `normals` `[row][texel]` in the row that `directions` names for it.
    ///
    /// There are up to [`MAX_LOBES`](crate::data::MAX_LOBES) lobes. ρ_d is 0 without lit samples, and so is ρ_s of a lobe with
    /// less than [`MIN_LOBE_ENERGY`]. Of lobes that the samples do not tell apart, the first has it all.
    ///
    /// # Errors
    /// [`GpuError`] if the result does not fit the adapter.
    pub fn record(
        &self, recorder: &mut Recorder<'_>, radiance: &Tile, shading: &Buffer<[f16; OCTET]>, directions: &Buffer<SampleDirections>,
        normals: &Buffer<[f32; 4]>, lobes: &Buffer<[f32; 4]>,
    ) -> Result<Refitted, GpuError> {
        let gpu = recorder.gpu();
        let samples = LocalSamples { radiance, shading, directions, normals, lobes };
        let params = Params {
            texels: count(radiance.texels),
            octets: count(radiance.octets()),
            lobes: count(samples.lobe_count()),
            min_energy: single(MIN_LOBE_ENERGY),
        };
        let params = gpu.uniform("linear_refit params", &params)?;
        let diffuse = gpu.fresh("refitted diffuse", radiance.texels)?;
        let specular = gpu.fresh("refitted specular", samples.lobe_count() * radiance.texels)?;
        let mut binds = vec![bind("params", &params), bind("diffuse", &diffuse), bind("specular", &specular)];
        binds.extend(samples.binds());
        recorder.dispatch(&self.kernel, &binds, Grid::threads(radiance.texels))?;
        Ok(Refitted { diffuse, specular })
    }
}
