//! Each texel in a shading frame of its own: that of the height field's normal, there or at the point that a view sees, in the light that
//! reaches it. Lobes are fitted to the radiance itself, ρ_d along with them, and in the end ρ_d and all ρ_s are found together by linear
//! least squares: no quantile underestimates ρ_d, and nothing is divided by a small cosine.

use super::{FittedTile, Stages};
use crate::{
    data::{Candidate, Direction, Samples},
    gpu::{Buffer, Gpu},
    model::{FitSettings, Frame, Relief},
    pipeline::{
        PipelineError, Progress,
        tiles::{Job, run},
    },
    stage::{self, HeightField, SampleDirections, Seen, Shaded, Tile, upload_directions},
};

pub(super) struct LocalFit<'a> {
    gpu: &'a Gpu,
    progress: &'a Progress,
    settings: &'a FitSettings,
    samples: Vec<usize>,
    stages: &'a Stages,
    framed: Framed<'a>,
}

impl<'a> LocalFit<'a> {
    /// Fitted to the given samples of the source.
    pub fn new(
        job: &Job<'a>, stages: &'a Stages, settings: &'a FitSettings, field: &'a HeightField, candidate: &Candidate, samples: Vec<usize>,
    ) -> Result<Self, PipelineError> {
        let Job { gpu, progress, .. } = *job;
        Ok(Self { gpu, progress, settings, stages, framed: Framed::new(job, stages, &samples, field, candidate)?, samples })
    }

    pub fn samples(&self) -> &[usize] {
        &self.samples
    }

    pub fn fit(&self, radiance: &Tile, places: &[[u32; 2]]) -> Result<FittedTile, PipelineError> {
        let Self { gpu, progress, stages, settings, .. } = self;
        let texels = radiance.texels;
        let size = [texels, radiance.samples];
        let FramedTile { seen, shaded } = self.framed.tile(radiance, places)?;
        let directions = &self.framed.directions;
        let refit = |lobes: &Buffer<[f32; 4]>| {
            run(gpu, progress, "linear_refit", size, |recorder| {
                stages.linear_refit.record(recorder, radiance, &shaded.shading, directions, &seen.normals, lobes)
            })
        };
        // A lobe that is zero everywhere, before there is any.
        let mut lobes = gpu.zeros("no lobe", texels)?;
        let mut coefficients = refit(&lobes)?;
        let mut found: Vec<[f32; 4]> = Vec::new();
        let mut objectives: Vec<[f32; 2]> = Vec::new();
        let mut outcomes: Vec<[u32; 2]> = Vec::new();
        for lobe in 0..settings.lobes {
            let residual = run(gpu, progress, "lobe_residual", size, |recorder| {
                stages.lobe_residual.record(recorder, &shaded, directions, &seen.normals, &lobes, &coefficients)
            })?;
            let fitted = run(gpu, progress, "lafortune_fit", size, |recorder| {
                stages.lafortune_fit.record_framed(recorder, &residual, &shaded.shading, directions, &seen.normals, texels, settings)
            })?;
            found.extend(fitted.lobes.read(gpu)?);
            let (of_lobe, ends) = (fitted.objectives.read(gpu)?, fitted.outcomes.read(gpu)?);
            if lobe == 0 {
                (objectives, outcomes) = (of_lobe, ends);
            } else {
                for (all, this) in objectives.iter_mut().zip(of_lobe) {
                    all[1] = this[1];
                }
                for (all, this) in outcomes.iter_mut().zip(ends) {
                    all[1] += this[1];
                }
            }
            lobes = gpu.upload("lobes", &found)?;
            coefficients = refit(&lobes)?;
        }
        Ok(FittedTile { coefficients, lobes, objectives, outcomes })
    }
}

/// What turns the samples of a tile into those of surface points.
pub(super) struct Framed<'a> {
    gpu: &'a Gpu,
    progress: &'a Progress,
    field: &'a HeightField,
    relief: Relief,
    frame: Frame,
    ambient: f64,
    views: Vec<Direction>,
    directions: Buffer<SampleDirections>,
    stages: &'a Stages,
}

/// The surface points of a tile.
pub(super) struct FramedTile {
    pub seen: Seen,
    pub shaded: Shaded,
}

impl<'a> Framed<'a> {
    /// For the given samples of the source.
    pub fn new(
        job: &Job<'a>, stages: &'a Stages, samples: &[usize], field: &'a HeightField, candidate: &Candidate,
    ) -> Result<Self, PipelineError> {
        let Job { gpu, source, progress, .. } = *job;
        let btf = source.btf();
        let rows: Vec<u32> = samples.iter().map(|&sample| stage::count(btf.pairs()[sample].view)).collect();
        let samples = Samples::new(samples.iter().map(|&sample| btf.directions(sample)).collect());
        let is_seen = candidate.frame == Frame::Seen;
        Ok(Self {
            gpu,
            progress,
            field,
            relief: Relief { displace: is_seen, shadow: is_seen, ..Relief::measured() },
            frame: candidate.frame,
            ambient: candidate.ambient,
            views: btf.views().to_vec(),
            directions: upload_directions(gpu, &samples, &rows)?,
            stages,
        })
    }

    pub fn directions(&self) -> &Buffer<SampleDirections> {
        &self.directions
    }

    pub fn tile(&self, radiance: &Tile, places: &[[u32; 2]]) -> Result<FramedTile, PipelineError> {
        let Self { gpu, progress, stages, field, relief, .. } = *self;
        let seen = if self.frame == Frame::Plane {
            let points = self.views.len() * places.len();
            Seen { normals: gpu.upload("upright normals", &vec![[0.0, 0.0, 1.0, 0.0]; points])?, points: gpu.zeros("points", points)? }
        } else {
            run(gpu, progress, "seen_surface", [radiance.texels, self.views.len()], |recorder| {
                stages.seen_surface.record(recorder, field, relief, &self.views, places)
            })?
        };
        let shaded = run(gpu, progress, "shading", [radiance.texels, radiance.samples], |recorder| {
            stages.shading.record(recorder, radiance, &self.directions, field, &seen, relief, self.ambient)
        })?;
        Ok(FramedTile { seen, shaded })
    }
}
