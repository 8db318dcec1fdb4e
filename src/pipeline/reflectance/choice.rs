//! Which way of taking the surface suits a source: each candidate is fitted to the same few texels, and the one that leaves the least of
//! their radiance is taken.

use super::{
    FittedTile, Model, lit_samples,
    local::{Framed, FramedTile},
};
use crate::{
    data::{Block, Candidate, Choice},
    model::{FitSettings, Frame, SurfaceMode},
    pipeline::{
        PipelineError,
        tiles::{Job, run},
    },
    stage::{self, HeightField},
};

/// Texels are measured in this many patches along each edge of the plane, each of so many texels along an edge: enough that the best
/// candidate is the best of the whole plane, and few of a large plane's chunks are read.
const PATCHES: usize = 4;
const PATCH: usize = 3;

/// Measures the candidates that the settings leave open.
pub(super) fn choose(job: &Job<'_>, settings: &FitSettings, field: &HeightField) -> Result<Choice, PipelineError> {
    let candidates: &[(SurfaceMode, Frame)] = match settings.surface {
        SurfaceMode::Flat => &[(SurfaceMode::Flat, Frame::Plane)],
        SurfaceMode::Rough => &[(SurfaceMode::Rough, Frame::Plane)],
        SurfaceMode::Local => &[(SurfaceMode::Local, Frame::Texel), (SurfaceMode::Local, Frame::Seen)],
        // Flat and rough have one lobe.
        SurfaceMode::Auto if settings.lobes > 1 => &[(SurfaceMode::Local, Frame::Texel), (SurfaceMode::Local, Frame::Seen)],
        SurfaceMode::Auto => &[
            (SurfaceMode::Local, Frame::Texel),
            (SurfaceMode::Local, Frame::Seen),
            (SurfaceMode::Flat, Frame::Plane),
            (SurfaceMode::Rough, Frame::Plane),
        ],
    };
    let is_rough = candidates.iter().any(|(surface, _)| *surface == SurfaceMode::Rough);
    let representative = if is_rough { Some(representative(job, settings, field)?) } else { None };
    let mut candidates: Vec<Candidate> =
        candidates.iter().map(|&(surface, frame)| Candidate { surface, frame, relative_rms: None }).collect();
    let mut texels = 0;
    if candidates.len() > 1 {
        let lit = lit_samples(job.source, settings)?;
        let (gathered, places) = job.sample(&lit, &patches(job.source.btf().size()))?;
        texels = places.len();
        let radiance = &gathered.tile;
        let radiance_error = stage::RadianceError::new(job.gpu)?;
        for candidate in &mut candidates {
            let model = Model::new(job, settings, field, candidate, representative, lit.clone())?;
            let FittedTile { coefficients, lobes, .. } = model.fit(&gathered, &places)?;
            let framed = Framed::new(job, &lit, field, candidate.frame)?;
            let FramedTile { seen, shaded } = framed.tile(radiance, &places)?;
            let sums = run(job.gpu, job.progress, "radiance_error", [texels, lit.len()], |recorder| {
                let (shading, directions) = (&shaded.shading, framed.directions());
                radiance_error.record(recorder, radiance, shading, directions, &seen.normals, &coefficients, &lobes)
            })?;
            let [error, all] = sums.read(job.gpu)?.iter().fold([0.0, 0.0], |[error, all], sums| [error + sums[0], all + sums[1]]);
            candidate.relative_rms = Some(f64::from(error / all.max(f32::MIN_POSITIVE)).sqrt());
        }
    }
    candidates.sort_by(|a, b| a.relative_rms.unwrap_or(0.0).total_cmp(&b.relative_rms.unwrap_or(0.0)));
    Ok(Choice { candidates, texels, representative })
}

/// The texel whose lobe serves all of a rough surface: the one that was named, or that with the flattest surroundings.
fn representative(job: &Job<'_>, settings: &FitSettings, field: &HeightField) -> Result<[usize; 2], PipelineError> {
    let [width, height] = job.source.btf().size();
    if let Some([column, row]) = settings.representative {
        return if column < width && row < height {
            Ok([column, row])
        } else {
            Err(PipelineError::NoSuchTexel { column, row, width, height })
        };
    }
    let flatness = stage::Flatness::new(job.gpu)?;
    let roughness = run(job.gpu, job.progress, "flatness", [width * height, 0], |recorder| flatness.record(recorder, field))?;
    let roughness = roughness.read(job.gpu)?;
    let flattest = (0..roughness.len()).min_by(|&a, &b| roughness[a].total_cmp(&roughness[b])).unwrap_or_default();
    Ok([flattest % width, flattest / width])
}

/// Patches spread evenly over a plane; the whole plane if it is small.
fn patches(size: [usize; 2]) -> Vec<Block> {
    if size.iter().any(|&side| side < PATCHES * PATCH) {
        let [width, height] = size.map(|side| side.min(PATCHES * PATCH));
        return vec![Block { column: 0, row: 0, width, height }];
    }
    // In the middle of each of the plane's parts.
    let start = |side: usize, part: usize| (2 * part + 1) * side / (2 * PATCHES) - PATCH / 2;
    let patch = |index: usize| Block {
        column: start(size[0], index % PATCHES),
        row: start(size[1], index / PATCHES),
        width: PATCH,
        height: PATCH,
    };
    (0..PATCHES * PATCHES).map(patch).collect()
}
