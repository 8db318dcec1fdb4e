//! Coordinates of texels in a basis of their samples' vectors. Kernel `lpca_project`, twin
//! [`reference::lpca_project`](crate::reference::lpca_project).
//!
//! Of everything that local PCA does this is the one that costs: two operations a value and vector. Sixteen vectors and four texels share what a
//! thread loads, and the basis is held as halves: rounding its orthonormal vectors changes their products by less than single precision sums them
//! to, since the errors of thousands of values are independent.

use half::f16;

use super::{
    lpca_members::Line,
    scalar::{count, single},
    tile::Tile,
};
use crate::{
    data::OCTET,
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct, wgsl,
};

gpu_struct! {
    struct Params { texels: u32, lines: u32, blocks: u32, scale: f32 }
}

/// Vectors that a thread takes.
const VECTORS: usize = 16;

/// Texels that a thread takes.
const TEXELS: usize = 4;

/// A basis on the adapter, with the centre that vectors are taken about.
#[derive(Debug)]
pub struct Basis {
    octets: Buffer<[f16; OCTET]>,
    rank: usize,
    scale: f64,
}

impl Basis {
    /// Orthonormal `vectors` `[vector][line][8]`. Coordinates come filled up with zeros to a multiple of 16.
    ///
    /// # Errors
    /// [`GpuError`] if they do not fit the adapter.
    ///
    /// # Panics
    /// If the vectors are no whole lines: the caller's bug.
    pub fn upload(gpu: &Gpu, vectors: &[&[f64]]) -> Result<Self, GpuError> {
        let values = vectors.first().map_or(1, |vector| vector.len());
        // A unit vector's values are about this small; halves hold them best near 1.
        #[expect(clippy::cast_precision_loss, reason = "a number of values")]
        let scale = (values as f64).sqrt().recip();
        let rank = vectors.len().max(1).next_multiple_of(VECTORS);
        let octets = gpu.upload("basis", &super::octets_by_line(vectors, scale.recip(), rank))?;
        Ok(Self { octets, rank, scale })
    }

    /// Coordinates of a texel.
    #[must_use]
    pub fn rank(&self) -> usize {
        self.rank
    }
}

/// What [`LpcaProject::record`] finds.
#[derive(Debug)]
pub struct Projected {
    /// `[texel][quad of coordinates]`
    pub coordinates: Buffer<[f32; 4]>,
    /// `[texel]` Σ_d s_d (x_d − c_d)².
    pub energies: Buffer<f32>,
}

/// The stage's kernel on one device.
#[derive(Debug)]
pub struct LpcaProject {
    kernel: Kernel,
}

impl LpcaProject {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let resources = [
            Resource::uniform::<Params>("params"),
            Resource::read::<[f16; OCTET]>("radiance"),
            Resource::read::<Line>("centre"),
            Resource::read::<Line>("energy_weights"),
            Resource::read::<[f16; OCTET]>("basis"),
            Resource::read_write::<[f32; 4]>("coordinates"),
            Resource::read_write::<f32>("energies"),
        ];
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::LPCA_PROJECT, wgsl::ALL, &resources)? })
    }

    /// Σ_d (x_d − c_d) b_jd of each texel and vector, c the `centre` `[line]`; and the energy about it, weighted by `energy_weights` `[line]`.
    /// Masked samples count as the centre.
    ///
    /// # Errors
    /// [`GpuError`] if the result does not fit the adapter.
    pub fn record(
        &self, recorder: &mut Recorder<'_>, radiance: &Tile, centre: &Buffer<Line>, energy_weights: &Buffer<Line>, basis: &Basis,
    ) -> Result<Projected, GpuError> {
        let gpu = recorder.gpu();
        let texels = radiance.texels;
        let blocks = basis.rank / VECTORS;
        let params =
            Params { texels: count(texels), lines: count(3 * radiance.octets()), blocks: count(blocks), scale: single(basis.scale) };
        let params = gpu.uniform("lpca_project params", &params)?;
        let coordinates = gpu.fresh("coordinates", texels * basis.rank / 4)?;
        let energies = gpu.fresh("energies", texels)?;
        recorder.dispatch(
            &self.kernel,
            &[
                bind("params", &params),
                bind("radiance", &radiance.values),
                bind("centre", centre),
                bind("energy_weights", energy_weights),
                bind("basis", &basis.octets),
                bind("coordinates", &coordinates),
                bind("energies", &energies),
            ],
            Grid::layers(texels.div_ceil(TEXELS), count(blocks)),
        )?;
        Ok(Projected { coordinates, energies })
    }
}
