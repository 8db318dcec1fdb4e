//! A block's samples into a tile of octets, those that are no radiance masked. Kernel `gather`, twin
//! [`reference::gather`](crate::reference::gather).
//!
//! A thread takes an octet of one texel: there are enough of them where a few texels have very many samples, and where many
//! texels have few; neighbours take neighbouring texels, so that their loads and stores lie side by side. Masked samples are
//! rare, so the count of a texel is an atomic that few threads reach, once each: a sum of integers, which is the same in
//! any order.

use half::f16;

use super::{scalar::count, tile::Tile};
use crate::{
    data::OCTET,
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct, wgsl,
};

gpu_struct! {
    struct Params { texels: u32, samples: u32, octets: u32, _pad: u32 }
}

/// A tile and what of it is masked.
#[derive(Debug)]
pub struct Gathered {
    /// The samples.
    pub tile: Tile,
    /// `[texel]` number of masked samples.
    pub masked: Buffer<u32>,
}

/// The stage's kernel on one device.
#[derive(Debug)]
pub struct Gather {
    kernel: Kernel,
}

impl Gather {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let resources = [
            Resource::uniform::<Params>("params"),
            Resource::read::<u32>("halves"),
            Resource::read_write::<[f16; OCTET]>("radiance"),
            Resource::read_write::<u32>("masked"),
        ];
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::GATHER, wgsl::ALL, &resources)? })
    }

    /// The tile of `halves` `[sample][channel][texel]`, two a word, the first in its low bits; the last word may be half full. A sample
    /// of which any channel is NaN, infinite or negative is masked, −0 becomes 0, and all others keep their bits.
    ///
    /// # Errors
    /// [`GpuError`] if the result does not fit the adapter.
    pub fn record(&self, recorder: &mut Recorder<'_>, halves: &Buffer<u32>, samples: usize, texels: usize) -> Result<Gathered, GpuError> {
        let gpu = recorder.gpu();
        let octets = samples.div_ceil(OCTET);
        let params = Params { texels: count(texels), samples: count(samples), octets: count(octets), _pad: 0 };
        let params = gpu.uniform("gather params", &params)?;
        let values = gpu.fresh("radiance", 3 * octets * texels)?;
        let masked = gpu.zeros("masked samples", texels)?;
        recorder.dispatch(
            &self.kernel,
            &[bind("params", &params), bind("halves", halves), bind("radiance", &values), bind("masked", &masked)],
            Grid::threads(octets * texels),
        )?;
        Ok(Gathered { tile: Tile { values, texels, samples }, masked })
    }
}
