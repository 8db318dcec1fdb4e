//! Exact quantile of each texel's valid samples per channel, which is ρ_d (thesis section 3.2.2, step 2). Kernel `percentile`,
//! twin [`reference::percentile`](crate::reference::percentile).
//!
//! Radix select by two bits: a histogram in workgroup memory would need either one workgroup a texel, whose loads of a
//! texel's samples lie a whole plane apart, or more memory than a workgroup has. Counting three digits in registers
//! reads the tile eight times, in the order in which it lies in memory.
//!
//! The number of valid samples is known after the first digit. The rank that belongs to it is looked up in a table, which the host
//! makes in double precision, so that it is that of numpy's rule for any number.

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
    struct Params { texels: u32, octets: u32, samples: u32, _pad: u32 }
}
gpu_struct! {
    struct Position { rank: u32, fraction: f32 }
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
            Resource::read::<Position>("positions"),
            Resource::read::<[f16; OCTET]>("values"),
            Resource::read_write::<[f32; 4]>("quantiles"),
        ];
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::PERCENTILE, wgsl::ALL, &resources)? })
    }

    /// The `quantile` (0 to 1) of each texel's valid values, `[texel]` with one channel a component and 0 in the fourth: order
    /// statistics exactly, numpy's linear rule between them; 0 without valid values.
    ///
    /// # Errors
    /// [`GpuError`] if the result does not fit the adapter.
    pub fn record(&self, recorder: &mut Recorder<'_>, values: &Tile, quantile: f64) -> Result<Buffer<[f32; 4]>, GpuError> {
        let gpu = recorder.gpu();
        let positions: Vec<Position> = (0..=values.samples).map(|valid| position(quantile, valid)).collect();
        let positions = gpu.upload("positions of the quantile", &positions)?;
        let params = Params { texels: count(values.texels), octets: count(values.octets()), samples: count(values.samples), _pad: 0 };
        let params = gpu.uniform("percentile params", &params)?;
        let quantiles = gpu.fresh("quantiles", values.texels)?;
        recorder.dispatch(
            &self.kernel,
            &[bind("params", &params), bind("positions", &positions), bind("values", &values.values), bind("quantiles", &quantiles)],
            Grid::threads(values.texels),
        )?;
        Ok(quantiles)
    }
}

/// Rank q(n − 1) in `valid` values.
fn position(quantile: f64, valid: usize) -> Position {
    #[expect(clippy::cast_precision_loss, reason = "samples are counted in thousands")]
    let position = quantile.clamp(0.0, 1.0) * valid.saturating_sub(1) as f64;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to the number of samples")]
    let rank = position.floor() as u32;
    Position { rank, fraction: single(position - position.floor()) }
}
