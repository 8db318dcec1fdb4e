//! Decoding of 8-bit sRGB tiles to linear halves. Kernel `srgb_decode`, twin
//! [`reference::srgb_decode`](crate::reference::srgb_decode).
//!
//! Images travel as the bytes they were stored as, a third of what linear floats would take, and become linear on the
//! adapter. Halves keep 11 bits: finer than an 8-bit code everywhere.

use super::{scalar::count, tile::Tile};
use crate::{
    data::OCTET,
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct, wgsl,
};

gpu_struct! {
    struct Params { texels: u32, samples: u32, octets: u32, _pad: u32 }
}

/// The stage's kernel on one device.
#[derive(Debug)]
pub struct SrgbDecode {
    kernel: Kernel,
}

impl SrgbDecode {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let resources =
            [Resource::uniform::<Params>("params"), Resource::read::<u32>("codes"), Resource::read_write::<[half::f16; OCTET]>("radiance")];
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::SRGB_DECODE, wgsl::ALL, &resources)? })
    }

    /// Linear radiance of `codes` `[sample][texel]` (RGBA, red in the lowest byte).
    ///
    /// # Errors
    /// [`GpuError`] if the result does not fit the adapter.
    pub fn record(&self, recorder: &mut Recorder<'_>, codes: &Buffer<u32>, samples: usize, texels: usize) -> Result<Tile, GpuError> {
        let gpu = recorder.gpu();
        let octets = samples.div_ceil(OCTET);
        let params =
            gpu.uniform("srgb_decode params", &Params { texels: count(texels), samples: count(samples), octets: count(octets), _pad: 0 })?;
        let values = gpu.fresh("radiance", 3 * octets * texels)?;
        recorder.dispatch(
            &self.kernel,
            &[bind("params", &params), bind("codes", codes), bind("radiance", &values)],
            Grid::threads(octets * texels),
        )?;
        Ok(Tile { values, texels, samples })
    }
}
