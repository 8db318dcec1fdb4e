//! Sums of the samples of clusters' members by their weights. Kernel `lpca_lift`, twin
//! [`reference::lpca_lift`](crate::reference::lpca_lift).
//!
//! With random clusters and signs for weights the same sums are a sketch of all texels, whose span is the range that a randomised SVD starts
//! from (Clarkson, Woodruff 2013, section 2; Halko, Martinsson, Tropp 2011): it costs an addition a value where a dense random matrix
//! costs one for each vector.

use half::f16;

use super::{
    lpca_members::{Line, MembersOnGpu},
    scalar::count,
    tile::Tile,
};
use crate::{
    data::OCTET,
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct, wgsl,
};

gpu_struct! {
    struct Params { texels: u32, lines: u32, quads: u32, quad: u32 }
}

/// Sums over tiles.
#[derive(Debug)]
pub struct Lifted {
    /// `[quad of weights][cluster][weight][line]`, a buffer a quad.
    sums: Vec<Buffer<Line>>,
    /// `[quad of weights][cluster][line]`, the same counts in each.
    counts: Vec<Buffer<Line>>,
    clusters: usize,
    lines: usize,
}

impl Lifted {
    /// Empty sums over `quads` fours of weights.
    ///
    /// # Errors
    /// [`GpuError`] if they do not fit the adapter.
    pub fn new(gpu: &Gpu, clusters: usize, quads: usize, lines: usize) -> Result<Self, GpuError> {
        let sums = (0..quads).map(|_| gpu.zeros("lifted sums", clusters * 4 * lines)).collect::<Result<_, _>>()?;
        let counts = (0..quads).map(|_| gpu.zeros("lifted counts", clusters * lines)).collect::<Result<_, _>>()?;
        Ok(Self { sums, counts, clusters, lines })
    }

    /// The sums `[quad of weights][cluster][weight of the quad][line]`.
    ///
    /// # Errors
    /// [`GpuError`] if the device stopped.
    pub fn sums(&self, gpu: &Gpu) -> Result<Vec<Vec<Line>>, GpuError> {
        self.sums.iter().map(|quad| quad.read(gpu)).collect()
    }

    /// How many samples of members are not masked, `[cluster][line]`.
    ///
    /// # Errors
    /// [`GpuError`] if the device stopped.
    pub fn counts(&self, gpu: &Gpu) -> Result<Vec<Line>, GpuError> {
        self.counts.first().map_or(Ok(Vec::new()), |counts| counts.read(gpu))
    }
}

/// The stage's kernel on one device.
#[derive(Debug)]
pub struct LpcaLift {
    kernel: Kernel,
}

impl LpcaLift {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let resources = [
            Resource::uniform::<Params>("params"),
            Resource::read::<[f16; OCTET]>("radiance"),
            Resource::read::<Line>("centre"),
            Resource::read::<[u32; 2]>("ranges"),
            Resource::read::<u32>("members"),
            Resource::read::<[f32; 4]>("weights"),
            Resource::read_write::<Line>("sums"),
            Resource::read_write::<Line>("counts"),
        ];
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::LPCA_LIFT, wgsl::ALL, &resources)? })
    }

    /// Adds to `lifted`, for each cluster and weight, Σ_t w_t (x_td − c_d) over the cluster's members in this tile that are not masked: w the
    /// `weights` `[member][quad]`, c the `centre` `[line]`.
    ///
    /// # Errors
    /// [`GpuError`] if the adapter is out of memory.
    ///
    /// # Panics
    /// If tile and sums differ in lines: the host's bug.
    pub fn record(
        &self, recorder: &mut Recorder<'_>, radiance: &Tile, centre: &Buffer<Line>, members: &MembersOnGpu, weights: &Buffer<[f32; 4]>,
        lifted: &Lifted,
    ) -> Result<(), GpuError> {
        let gpu = recorder.gpu();
        let lines = 3 * radiance.octets();
        assert_eq!(lines, lifted.lines, "lines of tile and sums");
        let quads = count(lifted.sums.len());
        for (quad, (sums, counts)) in (0..quads).zip(lifted.sums.iter().zip(&lifted.counts)) {
            let params = Params { texels: count(radiance.texels), lines: count(lines), quads, quad };
            let params = gpu.uniform("lpca_lift params", &params)?;
            recorder.dispatch(
                &self.kernel,
                &[
                    bind("params", &params),
                    bind("radiance", &radiance.values),
                    bind("centre", centre),
                    bind("ranges", &members.ranges),
                    bind("members", &members.texels),
                    bind("weights", weights),
                    bind("sums", sums),
                    bind("counts", counts),
                ],
                Grid::layers(lines, count(lifted.clusters)),
            )?;
        }
        Ok(())
    }
}
