//! A BTF compressed by local PCA on the adapter, ready to be looked at: what `reconstruct_lpca` and the render passes read
//! (`kernels/common/lpca.wgsl`).

use half::f16;

use super::{
    StageError, pack_directions,
    scalar::{count, single},
};
use crate::{
    data::{Direction, DirectionMesh, Lpca, nearest_samples},
    gpu::{Bind, Buffer, Gpu, GpuError, Resource, bind},
    gpu_struct,
    model::{Boundary, TexelSamples},
};

gpu_struct! {
    /// Shapes of the arrays and how they are interpolated.
    pub struct CompressedBtfParams {
        width: u32,
        height: u32,
        boundary: u32,
        texel_samples: u32,
        clusters: u32,
        components: u32,
        lights: u32,
        samples: u32,
        view_mesh: [u32; 2],
        light_mesh: [u32; 2],
        cosines: u32,
        _pad0: u32,
        _pad1: u32,
        _pad2: u32,
    }
}

/// Cluster map, weights and terms in adapter memory, and what interpolates between the measured directions.
#[derive(Debug)]
pub struct CompressedBtf {
    params: CompressedBtfParams,
    /// Meshes of views and lights, the table of their samples and the lights' cosines.
    directions: Buffer<[u32; 4]>,
    /// `[sample][cluster][term]`, (R, G, B, 0) in reflectance units.
    terms: Buffer<[f16; 4]>,
    /// `[word][row][column]`: the cluster, then two weights a word.
    texels: Buffer<u32>,
}

impl CompressedBtf {
    /// Uploads a local PCA whose pairs refer to `views` and `lights`.
    ///
    /// # Errors
    /// [`StageError::Pairs`] if a pair refers to no direction, [`StageError::LpcaTooLarge`] if an array exceeds the adapter's limit, or
    /// [`StageError::Gpu`].
    pub fn upload(gpu: &Gpu, lpca: &Lpca, views: &[Direction], lights: &[Direction], boundary: Boundary) -> Result<Self, StageError> {
        let (limit, adapter) = (gpu.max_array_bytes(), || gpu.adapter().name.clone());
        let bytes = (lpca.terms.len() / 3 * size_of::<[f16; 4]>()) as u64;
        if bytes > limit {
            return Err(StageError::LpcaTooLarge { bytes, adapter: adapter(), limit });
        }
        let bytes = (views.len() as u64).saturating_mul(lights.len() as u64).saturating_mul(size_of::<u32>() as u64);
        if bytes > limit {
            return Err(StageError::TooManyDirections { views: views.len(), lights: lights.len(), bytes, adapter: adapter(), limit });
        }
        let samples = nearest_samples(&lpca.pairs, views, lights)?;
        let mut directions = Vec::new();
        let [view_mesh, light_mesh] = [views, lights].map(|measured| pack_directions(&DirectionMesh::new(measured), &mut directions));
        let table = count(directions.len());
        extend_by_fours(&mut directions, samples.values().iter().map(|&sample| count(sample)));
        let cosines = count(directions.len());
        extend_by_fours(&mut directions, lights.iter().map(|light| single(light.vector().z).to_bits()));
        let terms: Vec<_> = lpca.terms.as_chunks().0.iter().map(|&[r, g, b]| [r, g, b, f16::ZERO]).collect();
        let mut texels = lpca.cluster.values().to_vec();
        for word in 0..lpca.components.div_ceil(2) {
            texels.extend(lpca.weights.chunks_exact(lpca.components).map(|weights| {
                let half = |component: usize| u32::from(weights.get(component).map_or(0, |weight| weight.to_bits()));
                half(2 * word) | half(2 * word + 1) << 16
            }));
        }
        let params = CompressedBtfParams {
            width: count(lpca.cluster.width()),
            height: count(lpca.cluster.height()),
            boundary: boundary.code(),
            texel_samples: TexelSamples::default().count(),
            clusters: count(lpca.clusters),
            components: count(lpca.components),
            lights: count(lights.len()),
            samples: table,
            view_mesh,
            light_mesh,
            cosines,
            ..Default::default()
        };
        Ok(Self {
            params,
            directions: gpu.upload("directions", &directions)?,
            terms: gpu.upload("terms", &terms)?,
            texels: gpu.upload("texels", &texels)?,
        })
    }

    /// Columns and rows.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        [self.params.width, self.params.height]
    }

    /// Number of terms under one view and light: a mean and eigenvectors of each cluster.
    pub(super) fn terms(&self) -> usize {
        self.params.clusters as usize * (1 + self.params.components as usize)
    }

    /// What a pass that imports `lpca` declares.
    #[must_use]
    pub fn resources() -> Vec<Resource> {
        vec![
            Resource::uniform::<CompressedBtfParams>("btf"),
            Resource::read::<[u32; 4]>("directions"),
            Resource::read::<[f16; 4]>("terms"),
            Resource::read::<u32>("texels"),
        ]
    }

    /// What such a pass binds, `params` from [`Self::params`].
    #[must_use]
    pub fn binds<'a>(&'a self, params: &'a Buffer<CompressedBtfParams>) -> Vec<Bind<'a>> {
        vec![bind("btf", params), bind("directions", &self.directions), bind("terms", &self.terms), bind("texels", &self.texels)]
    }

    /// The uniform block of a picture that is interpolated from that many texels.
    ///
    /// # Errors
    /// [`GpuError`] if the adapter is out of memory.
    pub fn params(&self, gpu: &Gpu, texel_samples: TexelSamples) -> Result<Buffer<CompressedBtfParams>, GpuError> {
        gpu.uniform("compressed BTF", &CompressedBtfParams { texel_samples: texel_samples.count(), ..self.params })
    }
}

/// Appends values, four an element, the last filled up with 0.
fn extend_by_fours(elements: &mut Vec<[u32; 4]>, values: impl Iterator<Item = u32>) {
    for (index, value) in values.enumerate() {
        if index % 4 == 0 {
            elements.push([0; 4]);
        }
        if let Some(element) = elements.last_mut() {
            element[index % 4] = value;
        }
    }
}
