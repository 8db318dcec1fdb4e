//! Which way of taking the surface suits a source: each candidate is fitted to the same few texels and samples, and the one that leaves
//! the least of their radiance is taken.
//!
//! Along with it comes what a single view leaves open of the height. Photometric stereo of the zenith view flattens a relief, since what
//! its walls throw on each other lights its shadows, and an integral has no level. But seen obliquely a point stands beside its place by
//! its height over the plane that the pictures are rectified to, so that the right scale and level are those under which the points seen
//! explain the oblique views best. They are found by pattern search (Hooke, Jeeves 1961) with the same measure, together with the share
//! of light that the points of a relief throw on each other.

use super::{
    FittedTile, Model, Stages, lit_samples,
    local::{Framed, FramedTile},
};
use crate::{
    data::{Block, Candidate, Choice, Left},
    model::{FitSettings, Frame, SurfaceMode},
    pipeline::{
        PipelineError,
        geometry::Geometry,
        tiles::{Job, run},
    },
    stage::{self, Gathered, HeightField, Refitted},
};

/// Texels are measured in this many patches along each edge of the plane, each of so many texels along an edge: enough that the best
/// candidate is the best of the whole plane, and few of a large plane's chunks are read.
const PATCHES: usize = 4;
const PATCH: usize = 3;

/// Samples of a texel that are measured at most: enough to tell candidates that differ by a hundredth, since all of them see the same.
const MAX_SAMPLES: usize = 2048;

/// First steps of the search: a factor on the height, its level in standard deviations of the height, and the ambient share; and how often
/// they are halved.
const SCALE_STEP: f64 = 1.25;
const LEVEL_STEP: f64 = 0.5;
const AMBIENT_STEP: f64 = 0.1;
const HALVINGS: usize = 1;
/// A step is taken if it leaves at most this part of the cost: less would be rounding, as where a plane is flat.
const LEAST_GAIN: f64 = 0.999;
/// Bounds of the scale, the level (one outside the relief is none) and the ambient share.
const SCALES: [f64; 2] = [0.5, 3.0];
const MAX_LEVEL: f64 = 3.0;
const MAX_AMBIENT: f64 = 0.5;

/// The candidates that the settings leave open, best first, and the texel whose lobe serves all of a rough surface.
pub(in crate::pipeline) fn choose(
    job: &Job<'_>, stages: &Stages, settings: &FitSettings, geometry: &Geometry,
) -> Result<Choice, PipelineError> {
    let local = [Candidate::new(SurfaceMode::Local, Frame::Texel), Candidate::new(SurfaceMode::Local, Frame::Seen)];
    let [flat, rough] = [SurfaceMode::Flat, SurfaceMode::Rough].map(|surface| Candidate::new(surface, Frame::Plane));
    let mut candidates = match settings.surface {
        SurfaceMode::Flat => vec![flat],
        SurfaceMode::Rough => vec![rough],
        // Flat and rough have one lobe.
        SurfaceMode::Auto if settings.lobes == 1 => [local.as_slice(), &[flat, rough]].concat(),
        SurfaceMode::Local | SurfaceMode::Auto => local.to_vec(),
    };
    let is_rough = candidates.iter().any(|candidate| candidate.surface == SurfaceMode::Rough);
    let representative = if is_rough { Some(representative(job, settings, &geometry.field)?) } else { None };
    let mut texels = 0;
    if candidates.len() > 1 {
        let measure = Measure::new(job, stages, settings, geometry, representative)?;
        texels = measure.places.len();
        for candidate in &mut candidates {
            candidate.left = Some(measure.left(candidate)?);
        }
        // A single view sees no parallax.
        let seen = candidates.iter().find(|candidate| candidate.frame == Frame::Seen).filter(|_| job.source.btf().views().len() > 1);
        if let Some(better) = seen.map(|seen| measure.search(seen)).transpose()?.flatten() {
            candidates.push(better);
        }
        candidates.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
    }
    Ok(Choice { candidates, texels, representative })
}

/// Some texels and samples of a source.
struct Measure<'a> {
    job: &'a Job<'a>,
    settings: &'a FitSettings,
    geometry: &'a Geometry,
    representative: Option<[usize; 2]>,
    samples: Vec<usize>,
    gathered: Gathered,
    places: Vec<[u32; 2]>,
    stages: &'a Stages,
}

impl<'a> Measure<'a> {
    fn new(
        job: &'a Job<'a>, stages: &'a Stages, settings: &'a FitSettings, geometry: &'a Geometry, representative: Option<[usize; 2]>,
    ) -> Result<Self, PipelineError> {
        let lit = lit_samples(job.source, settings)?;
        // Evenly spread, by a step that is no whole number, so that it does not keep to the same lights of each view.
        let taken = lit.len().min(MAX_SAMPLES);
        let samples: Vec<usize> = (0..taken).map(|index| lit[index * lit.len() / taken]).collect();
        let (gathered, places) = job.sample(&samples, &patches(job.source.btf().size()))?;
        Ok(Self { job, stages, settings, geometry, representative, samples, gathered, places })
    }

    /// What a candidate leaves of the radiance.
    fn left(&self, candidate: &Candidate) -> Result<Left, PipelineError> {
        let Self { job, stages, settings, gathered, places, samples, .. } = self;
        let moved;
        let field = if candidate.has_measured_height() {
            &self.geometry.field
        } else {
            moved = self.geometry.with_height(job, candidate.height_scale, candidate.height_level)?.field;
            &moved
        };
        let model = Model::new(job, stages, settings, field, candidate, self.representative, samples.clone())?;
        let FittedTile { coefficients, lobes, .. } = model.fit(gathered, places)?;
        let framed = Framed::new(job, stages, samples, field, candidate)?;
        let FramedTile { seen, shaded } = framed.tile(&gathered.tile, places)?;
        let sums = run(job.gpu, job.progress, "radiance_error", [places.len(), samples.len()], |recorder| {
            let (shading, directions) = (&shaded.shading, framed.directions());
            let Refitted { diffuse, specular } = &coefficients;
            stages.radiance_error.record(recorder, &gathered.tile, shading, directions, &seen.normals, diffuse, specular, &lobes)
        })?;
        let sums = sums.read(job.gpu)?;
        let [squared_error, squares, error, radiance] = [0, 1, 2, 3].map(|of| sums.iter().map(|sums| f64::from(sums[of])).sum::<f64>());
        // Of nothing nothing is left.
        Ok(if squares > 0.0 {
            Left { relative_rms: (squared_error / squares).sqrt(), bias: error / radiance }
        } else {
            Left { relative_rms: 0.0, bias: 0.0 }
        })
    }

    /// The scale and level of the height with which `seen` leaves less than as it is, if there are such.
    fn search(&self, seen: &Candidate) -> Result<Option<Candidate>, PipelineError> {
        let heights = self.geometry.height.values();
        #[expect(clippy::cast_precision_loss, reason = "texels of a plane")]
        let deviation = (heights.iter().map(|&z| f64::from(z).powi(2)).sum::<f64>() / heights.len() as f64).sqrt();
        let mut best = *seen;
        let mut size = 1.0;
        for _ in 0..=HALVINGS {
            // One coordinate after the other; the way that helped is gone again.
            for step in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
                for way in [size, -size] {
                    loop {
                        let [scale, level, ambient] = step.map(|of| of * way);
                        let tried = Candidate {
                            height_scale: (best.height_scale * SCALE_STEP.powf(scale)).clamp(SCALES[0], SCALES[1]),
                            height_level: (best.height_level + level * LEVEL_STEP * deviation)
                                .clamp(-MAX_LEVEL * deviation, MAX_LEVEL * deviation),
                            ambient: (best.ambient + ambient * AMBIENT_STEP).clamp(0.0, MAX_AMBIENT),
                            ..best
                        };
                        let tried = Candidate { left: Some(self.left(&tried)?), ..tried };
                        // Nothing is better than what costs nothing.
                        let is_better = cost(&tried) < LEAST_GAIN * cost(&best);
                        if !is_better {
                            break;
                        }
                        best = tried;
                    }
                }
            }
            size /= 2.0;
        }
        Ok(Some(best).filter(|best| best != seen))
    }
}

/// The texel whose lobe serves all of a rough surface: the one that was named, or that with the flattest surroundings.
fn representative(job: &Job<'_>, settings: &FitSettings, field: &HeightField) -> Result<[usize; 2], PipelineError> {
    if let Some(named) = settings.representative {
        return Ok(named);
    }
    let flatness = stage::Flatness::new(job.gpu)?;
    let roughness = run(job.gpu, job.progress, "flatness", [job.source.btf().texels(), 0], |recorder| flatness.record(recorder, field))?;
    let roughness = roughness.read(job.gpu)?;
    let flattest = (0..roughness.len()).min_by(|&a, &b| roughness[a].total_cmp(&roughness[b])).unwrap_or_default();
    let width = job.source.btf().size()[0];
    Ok([flattest % width, flattest / width])
}

/// A candidate's cost; one that is not measured costs nothing.
fn cost(candidate: &Candidate) -> f64 {
    candidate.left.map_or(0.0, Left::cost)
}

/// Patches spread over a plane, one in each of its parts, at places that follow no period (Roberts 2018: the R2 sequence): a material that
/// repeats within the plane is not met at the same place each time. The upper left corner of a plane that is small.
fn patches(size: [usize; 2]) -> Vec<Block> {
    if size.iter().any(|&side| side < PATCHES * PATCH) {
        let [width, height] = size.map(|side| side.min(PATCHES * PATCH));
        return vec![Block { column: 0, row: 0, width, height }];
    }
    // 1/p and 1/p^2 of the plastic number p, p^3 = p + 1.
    const STEPS: [f64; 2] = [0.754_877_666_246_693, 0.569_840_290_998_053];
    let patch = |index: usize| {
        let part = [index % PATCHES, index / PATCHES];
        let [column, row] = [0, 1].map(|axis| {
            let [start, end] = [0, 1].map(|of| (part[axis] + of) * size[axis] / PATCHES);
            #[expect(clippy::cast_precision_loss, clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "texels of a part")]
            let within = ((index as f64 * STEPS[axis]).fract() * (end - start + 1 - PATCH) as f64) as usize;
            start + within
        });
        Block { column, row, width: PATCH, height: PATCH }
    };
    (0..PATCHES * PATCHES).map(patch).collect()
}
