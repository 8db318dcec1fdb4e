//! Clusters as they are stored, the texels' weights in them, and what is left.

use half::f16;
use nalgebra::DMatrix;
use rayon::prelude::*;

use super::{Cluster, Pca, Space};
use crate::{
    data::Map,
    pipeline::{PipelineError, tiles::run},
    stage::{ClusterTerms, Members, Weights, octets_by_line},
};

/// Of a symmetric matrix' eigenvalues, those below this part of the largest are taken as 0.
const NOISE: f64 = 1e-9;

/// What is stored of texels and clusters.
pub struct Stored {
    /// `[texel][component]`
    pub weights: Vec<f16>,
    /// `[sample][cluster][term][channel]`
    pub terms: Vec<f16>,
    pub error: Map<f32>,
    pub relative_rms: f64,
}

/// Rounds the first `components` directions of the clusters to halves, and finds each texel's weights in them.
pub fn store(pca: &mut Pca<'_>, clusters: &[Cluster], cluster_of: &[u32], components: usize) -> Result<Stored, PipelineError> {
    let Pca { tiles, stages, space } = pca;
    let (gpu, progress) = (tiles.job().gpu, tiles.job().progress);
    let quads = components.div_ceil(4);
    // [cluster][term][value]
    let stage = progress.stage("lpca_terms", tiles.texels(), tiles.samples());
    let rounded: Vec<Vec<Vec<f64>>> = clusters.par_iter().map(|cluster| terms(space, cluster, components)).collect();
    let duals: Vec<Vec<(f64, Vec<f64>)>> = rounded.par_iter().map(|terms| duals(space, &terms[1..])).collect();
    let terms_by_line = |terms: &Vec<Vec<f64>>| octets_by_line(&slices(terms), 1.0, 1 + 4 * quads);
    let duals_by_line =
        |duals: &Vec<(f64, Vec<f64>)>| octets_by_line(&duals.iter().map(|(_, dual)| dual.as_slice()).collect::<Vec<_>>(), 1.0, 4 * quads);
    let scales = |duals: &Vec<(f64, Vec<f64>)>| {
        let mut scales: Vec<f32> = duals.iter().map(|(scale, _)| crate::stage::single(*scale)).collect();
        scales.resize(4 * quads, 0.0);
        scales
    };
    let on_gpu = ClusterTerms {
        terms: gpu.upload("terms", &rounded.iter().flat_map(terms_by_line).collect::<Vec<_>>())?,
        duals: gpu.upload("duals", &duals.iter().flat_map(duals_by_line).collect::<Vec<_>>())?,
        scales: gpu.upload("scales of duals", duals.iter().flat_map(scales).collect::<Vec<_>>().as_chunks().0)?,
        quads,
    };
    drop((stage, duals));

    // [texel][quad][two words], Σ (R − L)², Σ L²
    let width = 2 * quads + 2;
    let found = tiles.map("lpca weights", width, |gathered, texels| {
        let own: Vec<u32> = texels.iter().map(|&texel| cluster_of[texel]).collect();
        let members = Members::new(&own, clusters.len());
        let found = run(gpu, progress, "lpca_weights", [texels.len(), gathered.tile.samples], |recorder| {
            stages.weights.record(recorder, &gathered.tile, &members, &on_gpu)
        })?;
        let Weights { weights, errors } = &found;
        let (weights, errors) = (weights.read(gpu)?, errors.read(gpu)?);
        let mut words = vec![0_u32; texels.len() * width];
        let by_member = members.texels.iter().zip(weights.as_flattened().chunks_exact(2 * quads)).zip(&errors);
        for ((&texel, weights), errors) in by_member {
            let own = &mut words[texel as usize * width..][..width];
            own[..2 * quads].copy_from_slice(weights);
            own[2 * quads..].copy_from_slice(&errors.map(f32::to_bits));
        }
        Ok(words)
    })?;
    let texels = found.chunks_exact(width);
    let errors: Vec<[f32; 2]> = texels.clone().map(|words| [0, 1].map(|sum| f32::from_bits(words[2 * quads + sum]))).collect();
    let [left, all] = [0, 1].map(|sum| errors.iter().map(|errors| f64::from(errors[sum])).sum::<f64>());
    let relative = |left: f64, all: f64| if all > 0.0 { (left / all).sqrt() } else { 0.0 };
    let error = errors.iter().map(|&[left, all]| crate::stage::single(relative(left.into(), all.into()))).collect();
    let halves = |words: &[u32]| {
        let own: Vec<f16> = bytemuck::cast_slice::<u32, f16>(&words[..2 * quads])[..components].to_vec();
        own
    };
    let [columns, rows] = tiles.job().source.btf().size();
    Ok(Stored {
        weights: texels.flat_map(halves).collect(),
        terms: by_sample(space, &rounded),
        error: Map::new(columns, rows, error)?,
        relative_rms: relative(left, all),
    })
}

/// A cluster's terms as halves hold them: its mean, and its directions times the standard deviation along them, as radiance.
fn terms(space: &Space, cluster: &Cluster, components: usize) -> Vec<Vec<f64>> {
    let round = |value: f64| f16::from_f64(value).to_f64();
    let mean = cluster.mean.iter().zip(&space.scale).map(|(&mean, &s)| if s > 0.0 { round(mean) } else { 0.0 }).collect();
    let direction = |index: usize| match (cluster.directions.get(index), cluster.energies.get(index)) {
        (Some(direction), Some(energy)) => {
            let deviation = (energy / cluster.members.max(1.0)).sqrt();
            direction.iter().zip(&space.scale).map(|(v, &s)| if s > 0.0 { round(deviation * v / s) } else { 0.0 }).collect()
        }
        _ => vec![0.0; space.values()],
    };
    std::iter::once(mean).chain((0..components).map(direction)).collect()
}

/// The duals of vectors: u_i with Σ_d u_id e_jd = δ_ij of least weighted norm, so that Σ_d u_id (x_d − m_d) is the weight of e_i of least error. Each over a
/// scale, which makes its largest value 1. A vector of zeros has none.
fn duals(space: &Space, vectors: &[Vec<f64>]) -> Vec<(f64, Vec<f64>)> {
    let gram = DMatrix::from_fn(vectors.len(), vectors.len(), |i, j| space.product(&vectors[i], &vectors[j]));
    let eigen = gram.symmetric_eigen();
    let least = NOISE * eigen.eigenvalues.iter().copied().fold(0.0, f64::max);
    let reciprocals = eigen.eigenvalues.map(|value| if value > least { value.recip() } else { 0.0 });
    let inverse = &eigen.eigenvectors * DMatrix::from_diagonal(&reciprocals) * eigen.eigenvectors.transpose();
    let dual = |index: usize| {
        let mut dual = vec![0.0; space.values()];
        for (vector, factor) in vectors.iter().zip(inverse.row(index).iter()) {
            for ((sum, value), s) in dual.iter_mut().zip(vector).zip(&space.scale) {
                *sum += factor * s * s * value;
            }
        }
        let scale = dual.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
        if scale > 0.0 {
            dual.iter_mut().for_each(|value| *value /= scale);
        }
        (scale, dual)
    };
    (0..vectors.len()).map(dual).collect()
}

/// `[cluster][term][value]` to `[sample][cluster][term][channel]`.
fn by_sample(space: &Space, terms: &[Vec<Vec<f64>>]) -> Vec<f16> {
    let mut halves = Vec::with_capacity(space.samples * terms.iter().map(|terms| 3 * terms.len()).sum::<usize>());
    for sample in 0..space.samples {
        for term in terms.iter().flatten() {
            halves.extend([0, 1, 2].map(|channel| f16::from_f64(term[space.at(sample, channel)])));
        }
    }
    halves
}

fn slices(vectors: &[Vec<f64>]) -> Vec<&[f64]> {
    vectors.iter().map(Vec::as_slice).collect()
}
