//! Alternation of assignment and PCA in the coordinates of a basis (Kambhatla, Leen 1997; Müller, Meseth, Klein 2003).
//!
//! What the basis leaves out of a texel is as far from every subspace inside its span, so that the choice of cluster is that of the full vectors.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::{Pca, Stages};
use crate::{
    gpu::{Buffer, Gpu},
    model::LpcaSettings,
    pipeline::{PipelineError, Progress, tiles::run},
    stage::{Basis, Members, Subspaces},
};

/// Starts at random of which the best goes on. Where an alternation ends depends on where it starts: single ones left 0.0665 to 0.0758 of the path-traced
/// blocks.
const STARTS: usize = 6;

/// New clusters in each of them, by when the order of their errors is that in the end, or nearly.
const TRIAL_ITERATIONS: usize = 4;

/// Texels that they take, and more where these are fewer than so many to a cluster.
const TRIAL_TEXELS: usize = 2048;
const TRIAL_MEMBERS: usize = 128;

/// A cluster in coordinates: its mean and orthonormal eigenvectors `[eigenvector][coordinate]`.
pub type Subspace = (Vec<f64>, Vec<Vec<f64>>);

/// Texels in the coordinates of a basis, on the adapter.
pub struct Coordinates {
    /// `[texel][quad of coordinates]`, as many texels in each as one binding holds.
    slices: Vec<Buffer<[f32; 4]>>,
    /// Coordinates, those that fill up included.
    pub rank: usize,
    /// Energy of all texels about the centre, and of each.
    pub energy: f64,
    pub energies: Vec<f32>,
    /// Part of the energy that the basis leaves out.
    pub left_out: f64,
}

impl Coordinates {
    /// Projects the texels to orthonormal `vectors` of the space. `what` names the result among those kept.
    pub fn project(pca: &mut Pca<'_>, vectors: &[Vec<f64>], what: &str) -> Result<Self, PipelineError> {
        let Pca { tiles, stages, space } = pca;
        let (gpu, progress) = (tiles.job().gpu, tiles.job().progress);
        let projectors = space.projectors(vectors);
        let flat = vec![0.0; space.values()];
        // A source without any variance has no basis.
        let projectors: Vec<&[f64]> = if projectors.is_empty() { vec![&flat] } else { projectors.iter().map(Vec::as_slice).collect() };
        let basis = Basis::upload(gpu, &projectors)?;
        let rank = basis.rank();
        let values = tiles.map(what, rank + 1, |gathered, texels| {
            let found = run(gpu, progress, "lpca_project", [texels.len(), gathered.tile.samples], |recorder| {
                stages.project.record(recorder, &gathered.tile, &space.centre_lines, &space.weight_lines, &basis)
            })?;
            let (coordinates, energies) = (found.coordinates.read(gpu)?, found.energies.read(gpu)?);
            let coordinates = coordinates.as_flattened();
            Ok(energies.iter().zip(coordinates.chunks_exact(rank)).flat_map(|(energy, own)| [&[*energy], own].concat()).collect())
        })?;
        let energies: Vec<f32> = values.iter().step_by(rank + 1).copied().collect();
        let energy: f64 = energies.iter().copied().map(f64::from).sum();
        let coordinates: Vec<f32> = values.chunks_exact(rank + 1).flat_map(|texel| &texel[1..]).copied().collect();
        drop(values);
        let inside: f64 = coordinates.iter().map(|&value| f64::from(value).powi(2)).sum();
        let at_once = usize::try_from(gpu.max_array_bytes()).unwrap_or(usize::MAX) / (rank * size_of::<f32>());
        let slices = coordinates.chunks(at_once.max(1) * rank).map(|slice| gpu.upload("coordinates", slice.as_chunks().0));
        let slices = slices.collect::<Result<_, _>>()?;
        let left_out = if energy > 0.0 { ((energy - inside) / energy).max(0.0) } else { 0.0 };
        Ok(Self { slices, rank, energy, energies, left_out })
    }

    pub fn texels(&self) -> usize {
        self.energies.len()
    }

    /// Those of `most` texels drawn at random; none if there are no more. (Evenly spaced ones may all lie alike on the yarns of a cloth.)
    fn thinned(&self, gpu: &Gpu, most: usize, random: &mut fastrand::Rng) -> Result<Option<Self>, PipelineError> {
        if self.texels() <= most {
            return Ok(None);
        }
        let all = self.slices.iter().map(|slice| slice.read(gpu)).collect::<Result<Vec<_>, _>>()?.concat();
        let quads = self.rank / 4;
        let texels = random.choose_multiple(0..self.texels(), most);
        let own: Vec<[f32; 4]> = texels.iter().flat_map(|&texel| &all[texel * quads..][..quads]).copied().collect();
        let energies: Vec<f32> = texels.iter().map(|&texel| self.energies[texel]).collect();
        let energy = energies.iter().copied().map(f64::from).sum();
        Ok(Some(Self { slices: vec![gpu.upload("some coordinates", &own)?], energy, energies, ..*self }))
    }

    /// The given texel's.
    fn of(&self, gpu: &Gpu, texel: usize) -> Result<Vec<f64>, PipelineError> {
        let quads = self.rank / 4;
        let mut first = 0;
        for slice in &self.slices {
            let texels = slice.len() / quads;
            if texel < first + texels {
                let own = slice.read_range(gpu, (texel - first) * quads..(texel - first + 1) * quads)?;
                return Ok(own.as_flattened().iter().copied().map(f64::from).collect());
            }
            first += texels;
        }
        Ok(vec![0.0; self.rank])
    }

    /// Each texel to the nearest of `subspaces`.
    fn assign(&self, gpu: &Gpu, progress: &Progress, stages: &Stages, subspaces: &Subspaces) -> Result<Assignment, PipelineError> {
        let mut assignment = Assignment { cluster_of: Vec::new(), residuals: Vec::new(), weights: Vec::new() };
        for slice in &self.slices {
            let texels = slice.len() / (self.rank / 4);
            let found = run(gpu, progress, "lpca_assign", [texels, 0], |recorder| stages.assign.record(recorder, slice, subspaces))?;
            assignment.cluster_of.append(&mut found.cluster.read(gpu)?);
            assignment.residuals.append(&mut found.residuals.read(gpu)?);
            assignment.weights.push(found.weights);
        }
        Ok(assignment)
    }

    /// The sums `[row][column]` of `lpca_covariance` of each cluster.
    fn products(
        &self, gpu: &Gpu, progress: &Progress, stages: &Stages, cluster_of: &[u32], subspaces: &Subspaces, clusters: usize,
    ) -> Result<Vec<DMatrix<f64>>, PipelineError> {
        let side = self.rank + 8;
        let mut sums = vec![DMatrix::zeros(side, side); clusters];
        let mut first = 0;
        for slice in &self.slices {
            let texels = slice.len() / (self.rank / 4);
            let members = Members::new(&cluster_of[first..first + texels], clusters);
            first += texels;
            let products = run(gpu, progress, "lpca_covariance", [texels, 0], |recorder| {
                stages.covariance.record(recorder, slice, subspaces, &members.upload(gpu)?)
            })?;
            let products = products.read(gpu)?;
            for (sum, own) in sums.iter_mut().zip(products.as_flattened().chunks_exact(side * side)) {
                // Blocks below the diagonal are not written.
                *sum += DMatrix::from_fn(side, side, |row, column| {
                    let (row, column) = if row / 8 > column / 8 { (column, row) } else { (row, column) };
                    f64::from(own[row * side + column])
                });
            }
        }
        Ok(sums)
    }
}

/// Texels given to subspaces.
struct Assignment {
    /// `[texel]`
    cluster_of: Vec<u32>,
    /// `[texel]` squared distance from the subspace.
    residuals: Vec<f32>,
    /// `[slice][texel][quad]` weights in the cluster.
    weights: Vec<Buffer<[f32; 4]>>,
}

/// Where an alternation ended.
pub struct Alternated {
    pub subspaces: Vec<Subspace>,
    pub cluster_of: Vec<u32>,
    /// `[texel][component]` coordinates about the cluster's mean along its eigenvectors.
    pub weights: Vec<f32>,
    /// Components of a texel's weights, those that fill up included.
    pub width: usize,
    /// Square root of the energy that was left after each assignment over that of the texels.
    pub errors: Vec<f64>,
}

/// Alternates from `start`, or from the best of some starts at random, until the error settles.
pub fn alternate(
    pca: &Pca<'_>, coordinates: &Coordinates, settings: &LpcaSettings, start: Option<Vec<Subspace>>,
) -> Result<Alternated, PipelineError> {
    let clusters = (settings.clusters as usize).min(coordinates.texels());
    let start = match start {
        Some(start) => start,
        None => best_start(pca, coordinates, settings, clusters)?,
    };
    Alternation::new(pca, coordinates, settings, clusters).run(start, settings.iterations as usize)
}

/// The best of some starts at random, after a few iterations with some of the texels.
fn best_start(pca: &Pca<'_>, coordinates: &Coordinates, settings: &LpcaSettings, clusters: usize) -> Result<Vec<Subspace>, PipelineError> {
    let mut random = fastrand::Rng::with_seed(u64::from(settings.seed));
    let thinned = coordinates.thinned(pca.tiles.job().gpu, TRIAL_TEXELS.max(TRIAL_MEMBERS * clusters), &mut random)?;
    let trial = Alternation::new(pca, thinned.as_ref().unwrap_or(coordinates), settings, clusters);
    let mut best: Option<Alternated> = None;
    for _ in 0..STARTS {
        let found = trial.run(trial.seeds(&mut random)?, TRIAL_ITERATIONS)?;
        if best.as_ref().is_none_or(|best| found.errors.last() < best.errors.last()) {
            best = Some(found);
        }
    }
    Ok(best.map(|best| best.subspaces).unwrap_or_default())
}

struct Alternation<'a> {
    gpu: &'a Gpu,
    progress: &'a Progress,
    stages: &'a Stages,
    coordinates: &'a Coordinates,
    clusters: usize,
    components: usize,
    /// Energy of the texels.
    total: f64,
}

impl<'a> Alternation<'a> {
    fn new(pca: &'a Pca<'_>, coordinates: &'a Coordinates, settings: &LpcaSettings, clusters: usize) -> Self {
        Self {
            gpu: pca.tiles.job().gpu,
            progress: pca.tiles.job().progress,
            stages: &pca.stages,
            coordinates,
            clusters,
            components: settings.components as usize,
            total: pca.space.energy(coordinates.energy, coordinates.texels()),
        }
    }

    /// At most so many times new clusters from what their members are; ends with an assignment.
    fn run(&self, mut subspaces: Vec<Subspace>, iterations: usize) -> Result<Alternated, PipelineError> {
        let Self { gpu, progress, stages, coordinates, clusters, components, total } = *self;
        let quads = components.div_ceil(4);
        let mut errors: Vec<f64> = Vec::new();
        // Energy left inside the basis: what is outside does not change.
        let mut last: Option<f64> = None;
        progress.expect(iterations);
        loop {
            let on_gpu = Subspaces::upload(gpu, &subspaces, coordinates.rank, quads)?;
            let Assignment { mut cluster_of, residuals, weights } = coordinates.assign(gpu, progress, stages, &on_gpu)?;
            let inside: f64 = residuals.iter().copied().map(f64::from).sum();
            let left = inside + coordinates.left_out * coordinates.energy;
            errors.push(if total > 0.0 { (left / total).sqrt() } else { 0.0 });
            let is_settled = last.is_some_and(|last| last - inside <= LpcaSettings::SETTLED * last);
            last = Some(inside);
            if is_settled || errors.len() > iterations {
                progress.advance((iterations + 1) - errors.len());
                let weights = weights.iter().map(|slice| slice.read(gpu)).collect::<Result<Vec<_>, _>>()?.concat();
                return Ok(Alternated { subspaces, cluster_of, weights: weights.as_flattened().to_vec(), width: 4 * quads, errors });
            }
            reseed(&mut cluster_of, &residuals, clusters);
            let products = coordinates.products(gpu, progress, stages, &cluster_of, &on_gpu, clusters)?;
            let stage = progress.stage("lpca_eigen", coordinates.texels(), 0);
            subspaces = products.par_iter().zip(&subspaces).map(|(products, (mean, _))| principal(products, mean, components)).collect();
            drop(stage);
            progress.advance(1);
        }
    }

    /// Texels drawn as k-means++ does, with probabilities by their squared distance from those drawn before (Arthur, Vassilvitskii 2007), as means of
    /// clusters without eigenvectors.
    fn seeds(&self, random: &mut fastrand::Rng) -> Result<Vec<Subspace>, PipelineError> {
        let Self { gpu, progress, stages, coordinates, clusters, .. } = *self;
        let mut drawn = random.usize(0..coordinates.texels());
        let mut distances = vec![f32::INFINITY; coordinates.texels()];
        let mut seeds: Vec<Subspace> = Vec::with_capacity(clusters);
        loop {
            seeds.push((coordinates.of(gpu, drawn)?, Vec::new()));
            if seeds.len() == clusters {
                return Ok(seeds);
            }
            let newest = Subspaces::upload(gpu, &seeds[seeds.len() - 1..], coordinates.rank, 1)?;
            let from_newest = coordinates.assign(gpu, progress, stages, &newest)?.residuals;
            for (distance, new) in distances.iter_mut().zip(from_newest) {
                *distance = distance.min(new);
            }
            let total: f64 = distances.iter().copied().map(f64::from).sum();
            let mut left = random.f64() * total;
            let found = distances.iter().position(|&distance| {
                left -= f64::from(distance);
                left < 0.0
            });
            // Fewer distinct texels than clusters: any will do.
            drawn = found.unwrap_or_else(|| random.usize(0..coordinates.texels()));
        }
    }
}

/// Gives each cluster without members the texel that is farthest from its own cluster.
fn reseed(cluster_of: &mut [u32], residuals: &[f32], clusters: usize) {
    let mut members = vec![0_usize; clusters];
    for &cluster in cluster_of.iter() {
        members[cluster as usize] += 1;
    }
    let empty: Vec<usize> = (0..clusters).filter(|&cluster| members[cluster] == 0).collect();
    if empty.is_empty() {
        return;
    }
    let mut farthest: Vec<usize> = (0..residuals.len()).collect();
    farthest.sort_by(|&a, &b| residuals[b].total_cmp(&residuals[a]).then(a.cmp(&b)));
    let mut farthest = farthest.into_iter();
    for cluster in empty {
        // Not one that is its cluster's last.
        if let Some(texel) = farthest.find(|&texel| members[cluster_of[texel] as usize] > 1) {
            members[cluster_of[texel] as usize] -= 1;
            members[cluster] = 1;
            cluster_of[texel] = crate::stage::count(cluster);
        }
    }
}

/// Mean and leading eigenvectors from the sums of products about an earlier mean.
fn principal(products: &DMatrix<f64>, about: &[f64], components: usize) -> Subspace {
    let rank = about.len();
    let members = products[(rank, rank)];
    if members < 1.0 {
        return (about.to_vec(), Vec::new());
    }
    let shift = DVector::from_fn(rank, |row, _| products[(row, rank)] / members);
    let covariance = products.view((0, 0), (rank, rank)) / members - &shift * shift.transpose();
    let mean = about.iter().zip(shift.iter()).map(|(old, shift)| old + shift).collect();
    let eigen = covariance.symmetric_eigen();
    let mut order: Vec<usize> = (0..rank).collect();
    order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
    let vectors = order
        .into_iter()
        .take(components)
        .filter(|&index| eigen.eigenvalues[index] > 0.0)
        .map(|index| eigen.eigenvectors.column(index).iter().copied().collect())
        .collect();
    (mean, vectors)
}
