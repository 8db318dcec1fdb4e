//! Clusters in the space of all samples, from their members' weights in the basis.
//!
//! Instead of eigenvectors as combinations of the basis, the samples themselves are regressed on the weights: what the basis leaves out of them comes back
//! as far as the weights explain it. It is a step of subspace iteration for each cluster, and takes a few operations a value. On the path-traced weave,
//! clusters found in 64 vectors leave 0.0753 of the radiance inside the basis and 0.0601 lifted; the textbook's own leave 0.0609.

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::{Alternated, Coordinates, Pca, Space, kept};
use crate::{
    data::OCTET,
    pipeline::{PipelineError, tiles::run},
    stage::{Lifted, Members},
};

/// Of a symmetric matrix' eigenvalues, those below this part of the largest are taken as 0.
const NOISE: f64 = 1e-9;

/// A cluster of texels.
pub struct Cluster {
    /// Number of texels.
    pub members: f64,
    /// Their mean, as radiance.
    pub mean: Vec<f64>,
    /// Orthonormal vectors of the space, and the energy of the members along each that the weights explain, the largest first.
    pub directions: Vec<Vec<f64>>,
    pub energies: Vec<f64>,
    /// Energy of the members about their mean.
    pub energy: f64,
}

impl Cluster {
    /// At most this energy of the members is left by the first `components` directions.
    pub fn left(&self, components: usize) -> f64 {
        (self.energy - self.energies.iter().take(components).sum::<f64>()).max(0.0)
    }
}

/// The clusters of an alternation. `what` names the sums among what is kept.
pub fn lift(pca: &mut Pca<'_>, coordinates: &Coordinates, found: &Alternated, what: &str) -> Result<Vec<Cluster>, PipelineError> {
    let Pca { tiles, stages, space } = pca;
    let (gpu, progress) = (tiles.job().gpu, tiles.job().progress);
    let clusters = found.subspaces.len();
    let components = found.subspaces.iter().map(|(_, eigenvectors)| eigenvectors.len()).max().unwrap_or_default();
    let (lines, quads) = (space.lines(), (1 + components).div_ceil(4));
    let weights_of = |texel: usize| &found.weights[texel * found.width..][..components];

    // [cluster][Σ x − c, Σ w (x − c) …, number][value]
    let sums = kept(tiles, what, |tiles| {
        let lifted = Lifted::new(gpu, clusters, quads, lines)?;
        tiles.for_each(|gathered, texels| {
            let own: Vec<u32> = texels.iter().map(|&texel| found.cluster_of[texel]).collect();
            let members = Members::new(&own, clusters);
            let mut weights = vec![[0.0_f32; 4]; members.texels.len() * quads];
            for (own, &member) in weights.as_flattened_mut().chunks_exact_mut(4 * quads).zip(&members.texels) {
                own[0] = 1.0;
                own[1..=components].copy_from_slice(weights_of(texels[member as usize]));
            }
            run(gpu, progress, "lpca_lift", [texels.len(), gathered.tile.samples], |recorder| {
                let weights = gpu.upload("weights", &weights)?;
                stages.lift.record(recorder, &gathered.tile, &space.centre_lines, &members.upload(gpu)?, &weights, &lifted)
            })
        })?;
        let (sums, counts) = (lifted.sums(gpu)?, lifted.counts(gpu)?);
        let of_cluster = |cluster: usize| {
            let of_weight = |weight: usize| &sums[weight / 4][(cluster * 4 + weight % 4) * lines..][..lines];
            let counts = &counts[cluster * lines..][..lines];
            (0..=components).map(of_weight).chain([counts]).collect::<Vec<_>>().concat()
        };
        Ok((0..clusters).flat_map(of_cluster).flat_map(|line| line.values()).collect())
    })?;

    let _stage = progress.stage("lpca_directions", tiles.texels(), tiles.samples());
    let mut members_of = vec![Vec::new(); clusters];
    for (texel, &cluster) in found.cluster_of.iter().enumerate() {
        members_of[cluster as usize].push(texel);
    }
    let of_cluster = |(sums, members): (&[f32], &Vec<usize>)| {
        let rows: Vec<&[f32]> = sums.chunks_exact(space.values()).collect();
        let weights = DMatrix::from_fn(components, members.len(), |row, column| f64::from(weights_of(members[column])[row]));
        let energy = members.iter().map(|&texel| f64::from(coordinates.energies[texel])).sum();
        cluster(space, &rows, &weights, energy)
    };
    Ok(sums.par_chunks_exact((2 + components) * lines * OCTET).zip(&members_of).map(of_cluster).collect())
}

/// A cluster from the sums over its members, their weights `[component][member]` and their energy about the centre.
fn cluster(space: &Space, sums: &[&[f32]], weights: &DMatrix<f64>, energy: f64) -> Cluster {
    let [components, count] = [weights.nrows(), weights.ncols()];
    #[expect(clippy::cast_precision_loss, reason = "a number of texels")]
    let members = count as f64;
    let counts = sums[1 + components];
    let shift: Vec<f64> = sums[0].iter().zip(counts).map(|(&sum, &count)| f64::from(sum) / f64::from(count).max(1.0)).collect();
    let mean = shift.iter().zip(&space.centre).map(|(shift, centre)| centre + shift).collect();
    let energy = (energy - members * space.product(&shift, &shift)).max(0.0);
    let mut cluster = Cluster { members, mean, directions: Vec::new(), energies: Vec::new(), energy };
    if components == 0 {
        return cluster;
    }

    // Weights about their mean: W W^T = U D U^T.
    let mean_weights = weights.column_mean();
    let mut centred = weights.clone();
    centred.column_iter_mut().for_each(|mut column| column -= &mean_weights);
    let eigen = (&centred * centred.transpose()).symmetric_eigen();
    let largest = eigen.eigenvalues.iter().copied().fold(0.0, f64::max);
    let spread: Vec<usize> = (0..components).filter(|&index| eigen.eigenvalues[index] > NOISE * largest).collect();
    if spread.is_empty() {
        // A single member, or members that are all alike.
        return cluster;
    }
    // What the weights explain of the members is W^T D^(-1/2) U^T S, S being the sums of members by weights.
    let decorrelate = DMatrix::from_fn(spread.len(), components, |row, column| {
        eigen.eigenvectors[(column, spread[row])] / eigen.eigenvalues[spread[row]].sqrt()
    });
    let of_weight = DMatrix::from_fn(space.values(), components, |value, component| {
        space.scale[value] * (f64::from(sums[1 + component][value]) - mean_weights[component] * f64::from(sums[0][value]))
    });
    let explained = of_weight * decorrelate.transpose();
    let eigen = explained.tr_mul(&explained).symmetric_eigen();
    let largest = eigen.eigenvalues.iter().copied().fold(0.0, f64::max);
    let mut order: Vec<usize> = (0..spread.len()).filter(|&index| eigen.eigenvalues[index] > NOISE * largest).collect();
    order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
    let combination = DMatrix::from_fn(spread.len(), order.len(), |row, column| {
        eigen.eigenvectors[(row, order[column])] / eigen.eigenvalues[order[column]].sqrt()
    });
    cluster.directions = (explained * combination).column_iter().map(|column| column.iter().copied().collect()).collect();
    cluster.energies = order.iter().map(|&index| eigen.eigenvalues[index]).collect();
    cluster
}
