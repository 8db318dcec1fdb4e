//! The original's full look, compressed: a local PCA of the texels (Müller, Meseth, Klein 2003), streamed.
//!
//! In four passes over the source, which stays on the adapter between them if it fits:
//! 1. [`sketch`]: a random sketch of all texels, and from it a global orthonormal basis;
//! 2. [`alternation`]: coordinates in the basis, where assignment and PCA alternate at a hundredth of the cost;
//! 3. [`mod@lift`]: the clusters' means and eigenvectors in full;
//! 4. [`weights`]: the texels' weights in what is stored, and its error.
//!
//! The direct method repeats 2 and 3 instead of alternating, with the span of the clusters themselves as the basis, in which their distances are exact.
//! Everything is deterministic for a seed; sums over tiles have the tiles' order, so that another bound on memory changes rounding.

mod alternation;
mod choice;
mod lift;
mod sketch;
mod space;
mod tiles;
mod weights;

use self::{
    alternation::{Alternated, Coordinates, alternate},
    lift::{Cluster, lift},
    space::Space,
    tiles::Tiles,
    weights::store,
};
use super::{Memory, PipelineError, Progress, tiles::Job};
use crate::{
    data::{Learned, Lpca, Map, OCTET},
    gpu::Gpu,
    io::{Source, Unfinished},
    model::{LpcaMethod, LpcaSettings},
    stage,
};

/// Compresses `source` by local PCA.
///
/// Works in tiles sized from the adapter's limits and `memory`. With `unfinished`, passes and tiles that an earlier run kept are not done again.
///
/// # Errors
/// [`PipelineError`] if the source cannot be read, a setting is out of range, the result would not fit the adapter, a pass cannot be kept, or the
/// adapter fails.
pub fn lpca(
    gpu: &Gpu, source: &dyn Source, settings: &LpcaSettings, memory: Memory, unfinished: Option<&Unfinished>, progress: &Progress,
) -> Result<Lpca, PipelineError> {
    check(gpu, source, settings)?;
    recover(&Job { gpu, source, memory, unfinished, progress }, settings)
}

/// The stages on one device.
struct Stages {
    lift: stage::LpcaLift,
    project: stage::LpcaProject,
    assign: stage::LpcaAssign,
    covariance: stage::LpcaCovariance,
    weights: stage::LpcaWeights,
}

impl Stages {
    fn new(gpu: &Gpu) -> Result<Self, PipelineError> {
        Ok(Self {
            lift: stage::LpcaLift::new(gpu)?,
            project: stage::LpcaProject::new(gpu)?,
            assign: stage::LpcaAssign::new(gpu)?,
            covariance: stage::LpcaCovariance::new(gpu)?,
            weights: stage::LpcaWeights::new(gpu)?,
        })
    }
}

/// As [`lpca`], of settings that were checked.
pub(super) fn recover(job: &Job<'_>, settings: &LpcaSettings) -> Result<Lpca, PipelineError> {
    let btf = job.source.btf();
    let stages = Stages::new(job.gpu)?;
    let mut tiles = Tiles::new(job, reserved(job, settings));
    let sketch = sketch::sketch(&mut tiles, &stages, settings)?;
    let space = Space::new(job.gpu, btf, &sketch, settings.weighting)?;
    let vectors = sketch::basis(&space, &sketch, settings);
    drop(sketch);
    let mut pca = Pca { tiles, stages, space };
    let coordinates = Coordinates::project(&mut pca, &vectors, "lpca coordinates")?;
    let (settings, candidates) = choice::choose(&mut pca, &coordinates, settings)?;
    let (found, clusters) = match settings.method {
        LpcaMethod::Basis => {
            let found = alternate(&pca, &coordinates, &settings, None)?;
            let clusters = lift(&mut pca, &coordinates, &found, "lpca lift")?;
            (found, clusters)
        }
        LpcaMethod::Direct => pca.direct(&coordinates, &settings)?,
    };
    let components = settings.components as usize;
    let stored = store(&mut pca, &clusters, &found.cluster_of, components)?;
    let [columns, rows] = btf.size();
    let lpca = Lpca {
        pairs: btf.pairs().to_vec(),
        clusters: clusters.len(),
        components,
        cluster: Map::new(columns, rows, found.cluster_of)?,
        weights: stored.weights,
        terms: stored.terms,
        error: stored.error,
        learned: Learned {
            relative_rms: stored.relative_rms,
            rank: vectors.len(),
            left_out: coordinates.left_out,
            errors: found.errors,
            candidates,
        },
    };
    lpca.check(btf.size())?;
    Ok(lpca)
}

/// What every step needs.
struct Pca<'a> {
    tiles: Tiles<'a>,
    stages: Stages,
    space: Space,
}

impl Pca<'_> {
    /// Alternates in the span of the clusters themselves, from one alternation in the basis.
    fn direct(&mut self, coordinates: &Coordinates, settings: &LpcaSettings) -> Result<(Alternated, Vec<Cluster>), PipelineError> {
        let once = LpcaSettings { iterations: 1, ..*settings };
        let mut found = alternate(self, coordinates, &once, None)?;
        let mut clusters = lift(self, coordinates, &found, "lpca lift 0")?;
        let mut errors: Vec<f64> = Vec::new();
        for round in 1..=settings.iterations {
            let means: Vec<Vec<f64>> = clusters.iter().map(|cluster| self.space.vector(&cluster.mean)).collect();
            let all: Vec<Vec<f64>> = means.iter().chain(clusters.iter().flat_map(|cluster| &cluster.directions)).cloned().collect();
            let span = sketch::orthonormal(&all, all.len(), |_, _| false);
            let coordinates = Coordinates::project(self, &span, &format!("lpca coordinates {round}"))?;
            let inside = |vector: &Vec<f64>| {
                let mut own: Vec<f64> = span.iter().map(|axis| axis.iter().zip(vector).map(|(a, b)| a * b).sum()).collect();
                own.resize(coordinates.rank, 0.0);
                own
            };
            let start = means.iter().zip(&clusters).map(|(mean, cluster)| (inside(mean), cluster.directions.iter().map(inside).collect()));
            found = alternate(self, &coordinates, &once, Some(start.collect()))?;
            clusters = lift(self, &coordinates, &found, &format!("lpca lift {round}"))?;
            // Of the clusters that were lifted last, which their span holds.
            let error = found.errors[0];
            let is_settled = errors.last().is_some_and(|&last| last.powi(2) - error.powi(2) <= LpcaSettings::SETTLED * last.powi(2));
            errors.push(error);
            if is_settled {
                break;
            }
        }
        found.errors = errors;
        Ok((found, clusters))
    }
}

/// Checks that the settings are in range, and that a renderer may bind the terms.
pub(super) fn check(gpu: &Gpu, source: &dyn Source, settings: &LpcaSettings) -> Result<(), PipelineError> {
    settings.checked()?;
    let samples = source.btf().pairs().len();
    if let Some(target) = settings.target {
        return choice::check(source.btf(), target);
    }
    let (clusters, components) = (settings.clusters as usize, settings.components as usize);
    let (bytes, limit) = (Lpca::adapter_bytes(0, samples, clusters, components), gpu.max_array_bytes());
    if bytes > limit {
        let adapter = gpu.adapter().name.clone();
        return Err(PipelineError::LpcaTooLarge { clusters, components, samples, bytes, adapter, limit });
    }
    Ok(())
}

/// Bytes of the adapter's memory that coordinates, sums and terms take at most, by and large.
fn reserved(job: &Job<'_>, settings: &LpcaSettings) -> u64 {
    let btf = job.source.btf();
    let lines = 3 * btf.pairs().len().div_ceil(OCTET);
    let rank = settings.rank.unwrap_or(settings.auto_rank()) as usize;
    let (clusters, components) = (settings.clusters as usize, settings.components as usize);
    let coordinates = btf.texels() * (rank + components + 2) * size_of::<f32>();
    let sums = clusters.max(rank / 4) * (components + 4) * lines * size_of::<stage::Line>();
    (coordinates + 2 * sums) as u64
}

/// What `find` finds, or what an earlier run kept of it under the name `what`.
fn kept(
    tiles: &mut Tiles<'_>, what: &str, find: impl FnOnce(&mut Tiles<'_>) -> Result<Vec<f32>, PipelineError>,
) -> Result<Vec<f32>, PipelineError> {
    let unfinished = tiles.job().unfinished;
    if let Some(bytes) = unfinished.and_then(|unfinished| unfinished.get(what)) {
        return Ok(bytemuck::pod_collect_to_vec(&bytes));
    }
    let found = find(tiles)?;
    if let Some(unfinished) = unfinished {
        unfinished.put(what, bytemuck::cast_slice(&found))?;
    }
    Ok(found)
}
