//! Per-texel reflectance of a source, tile by tile (thesis section 3.2.2, flat surfaces).

use super::{
    PipelineError, Progress,
    tiles::{Memory, for_each_tile, run},
};
use crate::{
    data::{Fit, Map, Samples, Svbrdf},
    gpu::Gpu,
    io::Source,
    model::FitSettings,
    stage,
};

/// ρ_d, ρ_s and lobe of every texel, and how the fit went.
pub(super) fn recover(
    gpu: &Gpu, source: &dyn Source, settings: &FitSettings, memory: Memory, progress: &Progress,
) -> Result<(Svbrdf, Fit), PipelineError> {
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
    let decode = stage::SrgbDecode::new(gpu)?;
    let brdf_values = stage::BrdfValues::new(gpu)?;
    let percentile = stage::Percentile::new(gpu)?;
    let specular_residual = stage::SpecularResidual::new(gpu)?;
    let lafortune_fit = stage::LafortuneFit::new(gpu)?;
    let specular_scale = stage::SpecularScale::new(gpu)?;

    let mut found = Found::default();
    for_each_tile(gpu, source, &lit, memory, progress, |texels, codes| {
        let texels = texels.len();
        let size = [texels, samples.len()];
        let radiance = run(gpu, progress, "srgb_decode", size, |recorder| {
            let codes = gpu.upload("codes", codes)?;
            decode.record(recorder, &codes, samples.len(), texels)
        })?;
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
        found.diffuse.extend(diffuse.read(gpu)?);
        found.specular.extend(specular.read(gpu)?);
        found.lobes.extend(fitted.lobes.read(gpu)?);
        found.objectives.extend(fitted.objectives.read(gpu)?);
        found.outcomes.extend(fitted.outcomes.read(gpu)?);
        Ok(())
    })?;
    found.into_maps(btf.size())
}

/// Results of the tiles so far, in the order of texels.
#[derive(Default)]
struct Found {
    diffuse: Vec<[f32; 4]>,
    specular: Vec<[f32; 4]>,
    lobes: Vec<[f32; 4]>,
    objectives: Vec<[f32; 2]>,
    outcomes: Vec<[u32; 2]>,
}

impl Found {
    fn into_maps(self, [width, height]: [usize; 2]) -> Result<(Svbrdf, Fit), PipelineError> {
        let rgb = |&[r, g, b, _]: &[f32; 4]| [r, g, b];
        let objectives = Map::new(width, height, self.objectives)?;
        let outcomes = Map::new(width, height, self.outcomes)?;
        let svbrdf = Svbrdf {
            diffuse: Map::new(width, height, self.diffuse)?.map(rgb),
            specular: Map::new(width, height, self.specular)?.map(rgb),
            lobe: Map::new(width, height, self.lobes)?,
        };
        let fit = Fit {
            objective_without_lobe: objectives.map(|[start, _]| *start),
            objective: objectives.map(|[_, end]| *end),
            iterations: outcomes.map(|[_, iterations]| *iterations),
            status: outcomes.map(|[status, _]| *status),
            masked: Map::from_fn(width, height, |_, _| 0),
        };
        Ok((svbrdf, fit))
    }
}
