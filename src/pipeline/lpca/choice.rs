//! Numbers of clusters and components by a target.
//!
//! Clusters are found once for each number of them and lifted with the most components that are tried; their spectra then tell what every smaller
//! number would leave.

use super::{Coordinates, Pca, alternate, lift};
use crate::{
    data::{Btf, Lpca, LpcaCandidate},
    model::{LpcaSettings, LpcaTarget},
    pipeline::PipelineError,
};

const CLUSTERS: [u32; 5] = [4, 8, 16, 32, 64];
const COMPONENTS: [u32; 6] = [2, 4, 6, 8, 12, 16];

/// Checks that what is tried holds something as small as `target` asks for.
pub fn check(btf: &Btf, target: LpcaTarget) -> Result<(), PipelineError> {
    let least = Lpca::adapter_bytes(btf.texels(), btf.pairs().len(), CLUSTERS[0] as usize, COMPONENTS[0] as usize);
    match target {
        LpcaTarget::Size(most) if most < least => Err(PipelineError::LpcaTarget { least }),
        LpcaTarget::Size(_) | LpcaTarget::Error(_) => Ok(()),
    }
}

/// The settings with the numbers that their target chooses, and what it chose from, the smallest first.
pub fn choose(
    pca: &mut Pca<'_>, coordinates: &Coordinates, settings: &LpcaSettings,
) -> Result<(LpcaSettings, Vec<LpcaCandidate>), PipelineError> {
    let Some(target) = settings.target else { return Ok((*settings, Vec::new())) };
    let (gpu, texels, samples) = (pca.tiles.job().gpu, pca.tiles.texels(), pca.tiles.samples());
    let bytes = |clusters: u32, components: u32| Lpca::adapter_bytes(texels, samples, clusters as usize, components as usize);
    let is_possible = |clusters: u32, components: u32| {
        let terms = Lpca::adapter_bytes(0, samples, clusters as usize, components as usize);
        let is_small = !matches!(target, LpcaTarget::Size(most) if bytes(clusters, components) > most);
        terms <= gpu.max_array_bytes() && is_small && clusters as usize <= texels
    };
    let total = pca.space.energy(coordinates.energy, texels);
    let mut candidates = Vec::new();
    for clusters in CLUSTERS {
        let possible: Vec<u32> = COMPONENTS.into_iter().filter(|&components| is_possible(clusters, components)).collect();
        let Some(&most) = possible.last() else { continue };
        let tried = LpcaSettings { clusters, components: most, ..*settings };
        let found = alternate(pca, coordinates, &tried, None)?;
        let lifted = lift(pca, coordinates, &found, &format!("lpca lift of {clusters} clusters"))?;
        candidates.extend(possible.into_iter().map(|components| {
            let left: f64 = lifted.iter().map(|cluster| cluster.left(components as usize)).sum();
            LpcaCandidate {
                clusters: clusters as usize,
                components: components as usize,
                bytes: bytes(clusters, components),
                error: if total > 0.0 { (left / total).sqrt() } else { 0.0 },
            }
        }));
    }
    candidates.sort_by_key(|candidate| candidate.bytes);
    let most_accurate = || candidates.iter().min_by(|a, b| a.error.total_cmp(&b.error));
    let chosen = match target {
        LpcaTarget::Error(most) => candidates.iter().find(|candidate| candidate.error <= most).or_else(most_accurate),
        LpcaTarget::Size(_) => most_accurate(),
    };
    let Some(chosen) = chosen else {
        return Err(PipelineError::LpcaTarget { least: bytes(CLUSTERS[0], COMPONENTS[0]) });
    };
    let (clusters, components) = (crate::stage::count(chosen.clusters), crate::stage::count(chosen.components));
    Ok((LpcaSettings { clusters, components, ..*settings }, candidates))
}
