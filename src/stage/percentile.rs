//! Exact quantile of each texel's samples per channel, which is ρ_d (thesis section 3.2.2, step 2). Kernel `percentile`,
//! twin [`reference::percentile`](crate::reference::percentile).
//!
//! Radix select by two bits: a histogram in workgroup memory would need either one workgroup a texel, whose loads of a
//! texel's samples lie a whole plane apart, or more memory than a workgroup has. Counting three digits in registers
//! reads the tile eight times, in the order in which it lies in memory.

use half::f16;

use super::{
    scalar::{count, single},
    tile::Tile,
};
use crate::{
    data::OCTET,
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct, wgsl,
};

gpu_struct! {
    struct Params { texels: u32, octets: u32, samples: u32, rank: u32, fraction: f32, _pad0: u32, _pad1: u32, _pad2: u32 }
}

/// The stage's kernel on one device.
#[derive(Debug)]
pub struct Percentile {
    kernel: Kernel,
}

impl Percentile {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let resources = [
            Resource::uniform::<Params>("params"),
            Resource::read::<[f16; OCTET]>("values"),
            Resource::read_write::<[f32; 4]>("quantiles"),
        ];
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::PERCENTILE, wgsl::ALL, &resources)? })
    }

    /// The `quantile` (0 to 1) of each texel's values, `[texel]` with one channel a component and 0 in the fourth: order
    /// statistics exactly, numpy's linear rule between them.
    ///
    /// # Errors
    /// [`GpuError`] if the result does not fit the adapter.
    pub fn record(&self, recorder: &mut Recorder<'_>, values: &Tile, quantile: f64) -> Result<Buffer<[f32; 4]>, GpuError> {
        let gpu = recorder.gpu();
        #[expect(clippy::cast_precision_loss, reason = "samples are counted in thousands")]
        let position = quantile.clamp(0.0, 1.0) * (values.samples - 1) as f64;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to the number of samples")]
        let rank = position.floor() as u32;
        let params = Params {
            texels: count(values.texels),
            octets: count(values.octets()),
            samples: count(values.samples),
            rank,
            fraction: single(position - position.floor()),
            ..Params::default()
        };
        let params = gpu.uniform("percentile params", &params)?;
        let quantiles = gpu.fresh("quantiles", values.texels)?;
        recorder.dispatch(
            &self.kernel,
            &[bind("params", &params), bind("values", &values.values), bind("quantiles", &quantiles)],
            Grid::threads(values.texels),
        )?;
        Ok(quantiles)
    }
}
