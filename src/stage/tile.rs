//! A tile's samples on the GPU.

use half::f16;

use super::scalar::single;
use crate::{
    data::{OCTET, Samples},
    gpu::{Buffer, Gpu, GpuError},
};

/// The samples of a block of texels: halves in octets, `[channel][octet][texel]`.
///
/// A negative half, -1 where [`Gather`](super::Gather) makes it, marks a masked sample in all three channels alike: one that takes no
/// part in anything. -0 does not occur.
#[derive(Debug)]
pub struct Tile {
    /// The values, linear; zero after the last sample.
    pub values: Buffer<[f16; OCTET]>,
    /// Number of texels.
    pub texels: usize,
    /// Number of samples of a texel.
    pub samples: usize,
}

impl Tile {
    /// Number of octets of one texel and channel.
    #[must_use]
    pub fn octets(&self) -> usize {
        self.samples.div_ceil(OCTET)
    }
}

/// The directions of a tile's samples on the GPU: ω_i ω_o by components, `[sample filled up to octets]`, zero past the last.
///
/// # Errors
/// [`GpuError`] if they do not fit the adapter.
pub(super) fn upload_products(gpu: &Gpu, samples: &Samples) -> Result<Buffer<[f32; 4]>, GpuError> {
    let mut products: Vec<[f32; 4]> = samples.products().map(|[x, y, z]| [single(x), single(y), single(z), 0.0]).collect();
    products.resize(samples.octets() * OCTET, [0.0; 4]);
    gpu.upload("products of directions", &products)
}
