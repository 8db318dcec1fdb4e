//! Final weights of texels, from the samples and the clusters as they are stored. Kernel `lpca_weights`, twin
//! [`reference::lpca_weights`](crate::reference::lpca_weights).
//!
//! Eigenvectors that were rounded to halves are no longer quite orthonormal; their duals, which the host finds in double precision, give the weights of
//! least error all the same.

use half::f16;

use super::{lpca_members::Members, scalar::count, tile::Tile};
use crate::{
    data::OCTET,
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct, wgsl,
};

gpu_struct! {
    struct Params { texels: u32, lines: u32, members: u32, quads: u32 }
}

/// Means, eigenvectors and their duals of all clusters.
#[derive(Debug)]
pub struct ClusterTerms {
    /// `[cluster][line][1 + 4 quads]` mean and eigenvectors; those that a cluster lacks are zero.
    pub terms: Buffer<[f16; OCTET]>,
    /// `[cluster][line][4 quads]` duals of the eigenvectors, each over its scale.
    pub duals: Buffer<[f16; OCTET]>,
    /// `[cluster][quad]` scales of the duals.
    pub scales: Buffer<[f32; 4]>,
    /// Fours of eigenvectors.
    pub quads: usize,
}

/// What [`LpcaWeights::record`] finds.
#[derive(Debug)]
pub struct Weights {
    /// `[member][quad]` four halves.
    pub weights: Buffer<[u32; 2]>,
    /// `[member]` Σ (R − L)² and Σ L² over what is not masked.
    pub errors: Buffer<[f32; 2]>,
}

/// The stage's kernel on one device.
#[derive(Debug)]
pub struct LpcaWeights {
    kernel: Kernel,
}

impl LpcaWeights {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let resources = [
            Resource::uniform::<Params>("params"),
            Resource::read::<[f16; OCTET]>("radiance"),
            Resource::read::<u32>("members"),
            Resource::read::<u32>("cluster_of"),
            Resource::read::<[f16; OCTET]>("terms"),
            Resource::read::<[f16; OCTET]>("duals"),
            Resource::read::<[f32; 4]>("scales"),
            Resource::read_write::<[u32; 2]>("weights"),
            Resource::read_write::<[f32; 2]>("errors"),
        ];
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::LPCA_WEIGHTS, wgsl::ALL, &resources)? })
    }

    /// Weights w = scale·Σ_d u_d (x_d − m_d) and errors of the members, those that fill up included.
    ///
    /// # Errors
    /// [`GpuError`] if the result does not fit the adapter.
    pub fn record(
        &self, recorder: &mut Recorder<'_>, radiance: &Tile, members: &Members, terms: &ClusterTerms,
    ) -> Result<Weights, GpuError> {
        let gpu = recorder.gpu();
        let count_of_members = members.texels.len();
        let params = Params {
            texels: count(radiance.texels),
            lines: count(3 * radiance.octets()),
            members: count(count_of_members),
            quads: count(terms.quads),
        };
        let params = gpu.uniform("lpca_weights params", &params)?;
        let on_gpu = members.upload(gpu)?;
        let weights = gpu.fresh("weights", count_of_members * terms.quads)?;
        let errors = gpu.fresh("errors", count_of_members)?;
        recorder.dispatch(
            &self.kernel,
            &[
                bind("params", &params),
                bind("radiance", &radiance.values),
                bind("members", &on_gpu.texels),
                bind("cluster_of", &on_gpu.clusters),
                bind("terms", &terms.terms),
                bind("duals", &terms.duals),
                bind("scales", &terms.scales),
                bind("weights", &weights),
                bind("errors", &errors),
            ],
            Grid::threads(count_of_members / 4),
        )?;
        Ok(Weights { weights, errors })
    }
}
