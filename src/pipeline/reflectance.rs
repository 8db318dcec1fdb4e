//! Per-texel reflectance of a source, tile by tile (thesis section 3.2.2, flat surfaces).

use bytemuck::{Pod, Zeroable};

use super::{
    PipelineError,
    tiles::{Job, run},
};
use crate::{
    data::{Fit, Lobe, Map, Samples, Svbrdf},
    model::{FitSettings, Frame},
    stage,
};

/// ρ_d, ρ_s and lobe of every texel, and how the fit went.
pub(super) fn recover(job: &Job<'_>, settings: &FitSettings) -> Result<(Svbrdf, Fit), PipelineError> {
    let Job { gpu, source, progress, .. } = *job;
    let btf = source.btf();
    let lit: Vec<usize> = (0..btf.pairs().len()).filter(|&sample| btf.directions(sample).1.theta.cos() >= settings.min_cos_light).collect();
    if lit.is_empty() {
        return Err(PipelineError::OnlyGrazingLights {
            source_name: btf.name().to_owned(),
            samples: btf.pairs().len(),
            min_cos_light: settings.min_cos_light,
        });
    }
    let samples = Samples::new(lit.iter().map(|&sample| btf.directions(sample)).collect());
    let brdf_values = stage::BrdfValues::new(gpu)?;
    let percentile = stage::Percentile::new(gpu)?;
    let specular_residual = stage::SpecularResidual::new(gpu)?;
    let lafortune_fit = stage::LafortuneFit::new(gpu)?;
    let specular_scale = stage::SpecularScale::new(gpu)?;

    let texels = job.for_each_tile("reflectance", &lit, |gathered| {
        let (radiance, masked) = (gathered.tile, gathered.masked.read(gpu)?);
        let texels = masked.len();
        let size = [texels, samples.len()];
        let reflectance = run(gpu, progress, "brdf_values", size, |recorder| brdf_values.record(recorder, &radiance, &samples))?;
        drop(radiance);
        let diffuse =
            run(gpu, progress, "percentile", size, |recorder| percentile.record(recorder, &reflectance, settings.diffuse_quantile))?;
        let residual =
            run(gpu, progress, "specular_residual", size, |recorder| specular_residual.record(recorder, &reflectance, &diffuse))?;
        let fitted =
            run(gpu, progress, "lafortune_fit", size, |recorder| lafortune_fit.record(recorder, &residual, &samples, texels, settings))?;
        let specular = run(gpu, progress, "specular_scale", size, |recorder| {
            specular_scale.record(recorder, &reflectance, &samples, &diffuse, &fitted.lobes, settings)
        })?;
        let (diffuse, specular, lobes) = (diffuse.read(gpu)?, specular.read(gpu)?, fitted.lobes.read(gpu)?);
        let (objectives, outcomes) = (fitted.objectives.read(gpu)?, fitted.outcomes.read(gpu)?);
        let texel = |texel: usize| Texel {
            diffuse: diffuse[texel],
            specular: specular[texel],
            lobe: lobes[texel],
            objectives: objectives[texel],
            outcome: outcomes[texel],
            masked: masked[texel],
        };
        Ok((0..texels).map(texel).collect())
    })?;
    let [width, height] = btf.size();
    let texels = Map::new(width, height, texels)?;
    let rgb = |[r, g, b, _]: [f32; 4]| [r, g, b];
    let svbrdf = Svbrdf {
        frame: Frame::Plane,
        diffuse: texels.map(|texel| rgb(texel.diffuse)),
        lobes: vec![Lobe { specular: texels.map(|texel| rgb(texel.specular)), parameters: texels.map(|texel| texel.lobe) }],
    };
    let fit = Fit {
        objective_without_lobe: texels.map(|texel| texel.objectives[0]),
        objective: texels.map(|texel| texel.objectives[1]),
        iterations: texels.map(|texel| texel.outcome[1]),
        status: texels.map(|texel| texel.outcome[0]),
        masked: texels.map(|texel| texel.masked),
    };
    Ok((svbrdf, fit))
}

/// What is found for a texel.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Texel {
    diffuse: [f32; 4],
    specular: [f32; 4],
    lobe: [f32; 4],
    objectives: [f32; 2],
    outcome: [u32; 2],
    masked: u32,
}
