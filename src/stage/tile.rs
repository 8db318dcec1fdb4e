//! A tile's samples on the GPU.

use half::f16;

use super::scalar::single;
use crate::{
    data::{Direction, OCTET, Samples},
    gpu::{Buffer, Gpu, GpuError},
    gpu_struct,
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

gpu_struct! {
    /// Directions of one sample of a tile whose reflectance stands in the frames of normals
    /// (`kernels/common/shading_frame.wgsl`).
    pub struct SampleDirections {
        view: [f32; 3],
        row: u32,
        light: [f32; 3],
        _pad: u32,
    }
}

/// The directions of a tile's samples on the GPU, `[sample filled up to octets]`, zero past the last; `rows` has each sample's row of
/// normals.
///
/// # Errors
/// [`GpuError`] if they do not fit the adapter.
///
/// # Panics
/// If there are not as many rows as samples: the caller's bug.
pub fn upload_directions(gpu: &Gpu, samples: &Samples, rows: &[u32]) -> Result<Buffer<SampleDirections>, GpuError> {
    assert_eq!(rows.len(), samples.len(), "rows of normals and samples");
    let sample = |(&(view, light), &row): (&(Direction, Direction), &u32)| SampleDirections {
        view: view.vector().as_vec3().to_array(),
        row,
        light: light.vector().as_vec3().to_array(),
        _pad: 0,
    };
    let mut directions: Vec<_> = samples.directions().iter().zip(rows).map(sample).collect();
    directions.resize(samples.octets() * OCTET, SampleDirections::default());
    gpu.upload("directions of samples", &directions)
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
