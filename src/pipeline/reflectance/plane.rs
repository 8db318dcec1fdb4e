//! Flat and rough surfaces, as the thesis takes them: reflectance in the base plane's frame, ρ_d a quantile of it, one lobe for what is
//! above. Of a rough surface samples that lie in shadow are left out, and the flattest texel's lobe serves all.

use super::{FittedTile, Stages};
use crate::{
    data::{Block, FitStatus, Samples},
    gpu::Gpu,
    model::FitSettings,
    pipeline::{
        PipelineError, Progress,
        tiles::{Job, run},
    },
    stage::{Refitted, Tile},
};

/// Order statistic that the dark samples of a rough surface are held against.
const MEDIAN: f64 = 0.5;

pub(super) struct PlaneFit<'a> {
    gpu: &'a Gpu,
    progress: &'a Progress,
    stages: &'a Stages,
    settings: &'a FitSettings,
    lit: Vec<usize>,
    samples: Samples,
    is_rough: bool,
    /// (C_x, C_y, C_z, n) of a rough surface's representative texel, for all.
    shared: Option<[f32; 4]>,
}

impl<'a> PlaneFit<'a> {
    /// Each texel a flat surface of its own.
    pub fn flat(job: &Job<'a>, stages: &'a Stages, settings: &'a FitSettings, samples: &[usize]) -> Self {
        let Job { gpu, source, progress, .. } = *job;
        let btf = source.btf();
        Self {
            gpu,
            progress,
            stages,
            settings,
            samples: Samples::new(samples.iter().map(|&sample| btf.directions(sample)).collect()),
            lit: samples.to_vec(),
            is_rough: false,
            shared: None,
        }
    }

    /// A rough surface, with the lobe of the texel at `representative` (column, row).
    pub fn rough(
        job: &Job<'a>, stages: &'a Stages, settings: &'a FitSettings, samples: &[usize], [column, row]: [usize; 2],
    ) -> Result<Self, PipelineError> {
        let mut plane = Self { is_rough: true, ..Self::flat(job, stages, settings, samples) };
        let (gathered, _) = job.sample(&plane.lit, &[Block { column, row, width: 1, height: 1 }])?;
        let lobe = plane.fit(&gathered.tile)?.lobes.read(job.gpu)?;
        plane.shared = lobe.first().copied();
        Ok(plane)
    }

    pub fn samples(&self) -> &[usize] {
        &self.lit
    }

    pub fn fit(&self, radiance: &Tile) -> Result<FittedTile, PipelineError> {
        let Self { gpu, progress, stages, settings, samples, .. } = self;
        let texels = radiance.texels;
        let size = [texels, samples.len()];
        let quantile = |tile: &Tile, quantile: f64| {
            run(gpu, progress, "percentile", size, |recorder| stages.percentile.record(recorder, tile, quantile))
        };
        let mut reflectance = run(gpu, progress, "brdf_values", size, |recorder| stages.brdf_values.record(recorder, radiance, samples))?;
        if self.is_rough {
            let median = quantile(&reflectance, MEDIAN)?;
            reflectance =
                run(gpu, progress, "dark_samples", size, |recorder| stages.dark_samples.record(recorder, &reflectance, &median, settings))?;
        }
        let diffuse = quantile(&reflectance, settings.diffuse_quantile)?;
        let residual =
            run(gpu, progress, "specular_residual", size, |recorder| stages.specular_residual.record(recorder, &reflectance, &diffuse))?;
        let fitted = run(gpu, progress, "lafortune_fit", size, |recorder| match self.shared {
            None => stages.lafortune_fit.record(recorder, &residual, samples, texels, settings),
            Some(lobe) => stages.lafortune_fit.record_given(recorder, &residual, samples, texels, lobe, settings),
        })?;
        let specular = run(gpu, progress, "specular_scale", size, |recorder| {
            stages.specular_scale.record(recorder, &reflectance, samples, &diffuse, &fitted.lobes, settings)
        })?;
        let mut tile = FittedTile::of_lobe(gpu, Refitted { diffuse, specular }, fitted)?;
        if self.shared.is_some() {
            let without = [FitStatus::NoSpecular, FitStatus::TooFewSamples].map(|status| status as u32);
            for [status, _] in tile.outcomes.iter_mut().filter(|[status, _]| !without.contains(status)) {
                *status = FitStatus::Shared as u32;
            }
        }
        Ok(tile)
    }
}
