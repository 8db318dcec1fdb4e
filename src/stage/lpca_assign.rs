//! Texels to the nearest of the clusters' affine subspaces. Kernel `lpca_assign`, twin
//! [`reference::lpca_assign`](crate::reference::lpca_assign).

use super::scalar::{count, single};
use crate::{
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct, wgsl,
};

gpu_struct! {
    struct Params { texels: u32, rank: u32, clusters: u32, quads: u32 }
}

/// Texels that a thread takes.
const TEXELS: usize = 4;

/// Clusters in the coordinates of a basis, on the adapter.
#[derive(Debug)]
pub struct Subspaces {
    /// `[cluster][quad of coordinates]`
    pub means: Buffer<[f32; 4]>,
    /// `[cluster][quad of eigenvectors][coordinate]`
    eigenvectors: Buffer<[f32; 4]>,
    clusters: usize,
    rank: usize,
    quads: usize,
}

impl Subspaces {
    /// Clusters with the given mean `[coordinate]` and orthonormal eigenvectors `[eigenvector][coordinate]`, `rank` coordinates each (a multiple
    /// of 4), in fours of `quads` eigenvectors; those that a cluster lacks are zero.
    ///
    /// # Errors
    /// [`GpuError`] if they do not fit the adapter.
    ///
    /// # Panics
    /// If a vector has not `rank` coordinates: the caller's bug.
    pub fn upload(gpu: &Gpu, clusters: &[(Vec<f64>, Vec<Vec<f64>>)], rank: usize, quads: usize) -> Result<Self, GpuError> {
        let mut means = Vec::with_capacity(clusters.len() * rank / 4);
        let mut eigenvectors = vec![[0.0_f32; 4]; clusters.len() * quads * rank];
        for (cluster, (mean, own)) in clusters.iter().enumerate() {
            assert_eq!(mean.len(), rank, "coordinates of a mean");
            means.extend(mean.as_chunks::<4>().0.iter().map(|quad| quad.map(single)));
            for (index, eigenvector) in own.iter().take(4 * quads).enumerate() {
                assert_eq!(eigenvector.len(), rank, "coordinates of an eigenvector");
                for (coordinate, &value) in eigenvector.iter().enumerate() {
                    eigenvectors[(cluster * quads + index / 4) * rank + coordinate][index % 4] = single(value);
                }
            }
        }
        let means = gpu.upload("means", &means)?;
        let eigenvectors = gpu.upload("eigenvectors", &eigenvectors)?;
        Ok(Self { means, eigenvectors, clusters: clusters.len(), rank, quads })
    }

    pub(super) fn clusters(&self) -> usize {
        self.clusters
    }

    pub(super) fn rank(&self) -> usize {
        self.rank
    }
}

/// What [`LpcaAssign::record`] finds.
#[derive(Debug)]
pub struct Assigned {
    /// `[texel]`
    pub cluster: Buffer<u32>,
    /// `[texel]` squared distance from the cluster's subspace.
    pub residuals: Buffer<f32>,
    /// `[texel][quad]` coordinates about the cluster's mean, along its eigenvectors.
    pub weights: Buffer<[f32; 4]>,
}

/// The stage's kernel on one device.
#[derive(Debug)]
pub struct LpcaAssign {
    kernel: Kernel,
}

impl LpcaAssign {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let resources = [
            Resource::uniform::<Params>("params"),
            Resource::read::<[f32; 4]>("coordinates"),
            Resource::read::<[f32; 4]>("means"),
            Resource::read::<[f32; 4]>("eigenvectors"),
            Resource::read_write::<u32>("cluster_of"),
            Resource::read_write::<f32>("residuals"),
            Resource::read_write::<[f32; 4]>("weights"),
        ];
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::LPCA_ASSIGN, wgsl::ALL, &resources)? })
    }

    /// The cluster whose subspace is nearest to each texel's `coordinates` `[texel][quad]`, the first of equally near ones.
    ///
    /// # Errors
    /// [`GpuError`] if the result does not fit the adapter.
    pub fn record(&self, recorder: &mut Recorder<'_>, coordinates: &Buffer<[f32; 4]>, subspaces: &Subspaces) -> Result<Assigned, GpuError> {
        let gpu = recorder.gpu();
        let Subspaces { means, eigenvectors, clusters, rank, quads } = subspaces;
        let texels = coordinates.len() / (rank / 4);
        let params = Params { texels: count(texels), rank: count(rank / 4), clusters: count(*clusters), quads: count(*quads) };
        let params = gpu.uniform("lpca_assign params", &params)?;
        let cluster = gpu.fresh("clusters of texels", texels)?;
        let residuals = gpu.fresh("residuals", texels)?;
        let weights = gpu.fresh("weights", texels * quads)?;
        recorder.dispatch(
            &self.kernel,
            &[
                bind("params", &params),
                bind("coordinates", coordinates),
                bind("means", means),
                bind("eigenvectors", eigenvectors),
                bind("cluster_of", &cluster),
                bind("residuals", &residuals),
                bind("weights", &weights),
            ],
            Grid::threads(texels.div_ceil(TEXELS)),
        )?;
        Ok(Assigned { cluster, residuals, weights })
    }
}
