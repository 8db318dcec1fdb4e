//! Samples that are too dark to be lit are masked before ρ_d is taken as a quantile (thesis section 3.2.2, rough surfaces). Kernel
//! `dark_samples`, twin [`reference::dark_samples`](crate::reference::dark_samples).

use half::f16;

use super::{
    scalar::{count, single},
    tile::Tile,
};
use crate::{
    data::OCTET,
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct,
    model::FitSettings,
    wgsl,
};

gpu_struct! {
    struct Params { texels: u32, octets: u32, samples: u32, dark_fraction: f32 }
}

/// The stage's kernel on one device.
#[derive(Debug)]
pub struct DarkSamples {
    kernel: Kernel,
}

impl DarkSamples {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let resources = [
            Resource::uniform::<Params>("params"),
            Resource::read::<[f16; OCTET]>("reflectance"),
            Resource::read::<[f32; 4]>("median"),
            Resource::read_write::<[f16; OCTET]>("lit"),
        ];
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::DARK_SAMPLES, wgsl::ALL, &resources)? })
    }

    /// The tile with −1 in all channels of the samples whose mean reflectance over the channels is below
    /// [`FitSettings::dark_fraction`] times the mean of `median` `[texel]`, the texel's median of each channel
    /// ([`Percentile`](super::Percentile) with 0.5). All other samples, masked ones too, keep their bits.
    ///
    /// # Errors
    /// [`GpuError`] if the result does not fit the adapter.
    pub fn record(
        &self, recorder: &mut Recorder<'_>, reflectance: &Tile, median: &Buffer<[f32; 4]>, settings: &FitSettings,
    ) -> Result<Tile, GpuError> {
        let gpu = recorder.gpu();
        let (texels, samples, octets) = (reflectance.texels, reflectance.samples, reflectance.octets());
        let params =
            Params { texels: count(texels), octets: count(octets), samples: count(samples), dark_fraction: single(settings.dark_fraction) };
        let params = gpu.uniform("dark_samples params", &params)?;
        let lit = gpu.fresh("lit reflectance", 3 * octets * texels)?;
        recorder.dispatch(
            &self.kernel,
            &[bind("params", &params), bind("reflectance", &reflectance.values), bind("median", median), bind("lit", &lit)],
            Grid::threads(octets * texels),
        )?;
        Ok(Tile { values: lit, texels, samples })
    }
}
