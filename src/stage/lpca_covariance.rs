//! Sums that tell each cluster's mean and covariance. Kernel `lpca_covariance`, twin
//! [`reference::lpca_covariance`](crate::reference::lpca_covariance).
//!
//! Products are summed about the cluster's last mean, near the new one, so that nothing large is subtracted afterwards.

use super::{lpca_assign::Subspaces, lpca_members::MembersOnGpu, scalar::count};
use crate::{
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct, wgsl,
};

gpu_struct! {
    struct Params { rank: u32, clusters: u32 }
}

/// The stage's kernel on one device.
#[derive(Debug)]
pub struct LpcaCovariance {
    kernel: Kernel,
}

impl LpcaCovariance {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let resources = [
            Resource::uniform::<Params>("params"),
            Resource::read::<[f32; 4]>("coordinates"),
            Resource::read::<[f32; 4]>("means"),
            Resource::read::<[u32; 2]>("ranges"),
            Resource::read::<u32>("members"),
            Resource::read_write::<[f32; 4]>("products"),
        ];
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::LPCA_COVARIANCE, wgsl::ALL, &resources)? })
    }

    /// `[cluster][row][quad of columns]` Σ_t d_ti d_tj over each cluster's members, d = (a − m, 1, 0, …) with seven zeros: a the `coordinates`
    /// `[texel][quad]` and m the mean of `subspaces`. Blocks of 8 x 8 below the diagonal are not written.
    ///
    /// # Errors
    /// [`GpuError`] if the result does not fit the adapter.
    pub fn record(
        &self, recorder: &mut Recorder<'_>, coordinates: &Buffer<[f32; 4]>, subspaces: &Subspaces, members: &MembersOnGpu,
    ) -> Result<Buffer<[f32; 4]>, GpuError> {
        let gpu = recorder.gpu();
        let (clusters, rank) = (subspaces.clusters(), subspaces.rank() / 8);
        let params = gpu.uniform("lpca_covariance params", &Params { rank: count(rank), clusters: count(clusters) })?;
        let octets = rank + 1;
        let products = gpu.fresh("products of coordinates", clusters * 8 * octets * 2 * octets)?;
        recorder.dispatch(
            &self.kernel,
            &[
                bind("params", &params),
                bind("coordinates", coordinates),
                bind("means", &subspaces.means),
                bind("ranges", &members.ranges),
                bind("members", &members.texels),
                bind("products", &products),
            ],
            Grid::layers(octets * octets, count(clusters)),
        )?;
        Ok(products)
    }
}
