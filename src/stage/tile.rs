//! A tile's samples on the GPU.

use half::f16;

use super::scalar::single;
use crate::{
    data::{Direction, OCTET, Samples},
    gpu::{Buffer, Gpu, GpuError},
    gpu_struct,
};

gpu_struct! {
    /// Unit directions of a sample and the row of seen normals that its view has (`kernels/common/shading_frame.wgsl`).
    pub struct SampleDirections { view: [f32; 3], row: u32, light: [f32; 3], _pad: u32 }
}

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

/// The directions of a tile's samples on the GPU, `[sample filled up to octets]`, zero past the last; `rows` has each sample's row of seen
/// normals.
///
/// # Errors
/// [`GpuError`] if they do not fit the adapter.
pub fn upload_directions(gpu: &Gpu, samples: &Samples, rows: &[u32]) -> Result<Buffer<SampleDirections>, GpuError> {
    let vector = |direction: Direction| direction.vector().as_vec3().to_array();
    let of_sample = |(&(view, light), &row): (&(Direction, Direction), &u32)| SampleDirections {
        view: vector(view),
        row,
        light: vector(light),
        _pad: 0,
    };
    let mut directions: Vec<SampleDirections> = samples.directions().iter().zip(rows).map(of_sample).collect();
    directions.resize(samples.octets() * OCTET, SampleDirections::default());
    gpu.upload("directions", &directions)
}
