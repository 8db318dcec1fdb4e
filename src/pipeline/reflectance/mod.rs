//! Per-texel reflectance of a source, tile by tile (thesis section 3.2.2).
//!
//! A surface is taken as flat or rough, as the thesis does, or each texel in a frame of its own; [`choice`] says which, by what they leave
//! of some texels' radiance.

mod choice;
mod local;
mod plane;

pub(super) use choice::choose;

use bytemuck::{Pod, Zeroable};

use super::{PipelineError, tiles::Job};
use crate::{
    data::{Candidate, Choice, Fit, Lobe, MAX_LOBES, Map, Svbrdf},
    gpu::{Buffer, Gpu},
    io::Source,
    model::{FitSettings, SurfaceMode},
    stage::{self, FittedLobes, Gathered, HeightField, Refitted},
};
use local::LocalFit;
use plane::PlaneFit;

/// ρ_d, ρ_s and lobes of every texel, the surface taken as `choice` has it, and how the fit went.
pub(super) fn recover(
    job: &Job<'_>, stages: &Stages, settings: &FitSettings, field: &HeightField, choice: &Choice,
) -> Result<(Svbrdf, Fit), PipelineError> {
    let candidate = &choice.chosen();
    let samples = match candidate.surface {
        SurfaceMode::Flat | SurfaceMode::Rough => lit_samples(job.source, settings)?,
        SurfaceMode::Local | SurfaceMode::Auto => (0..job.source.btf().pairs().len()).collect(),
    };
    let model = Model::new(job, stages, settings, field, candidate, choice.representative, samples)?;
    let texels = job.for_each_tile("reflectance", 1, model.samples(), |gathered, places| {
        let masked = gathered.masked.read(job.gpu)?;
        let tile = model.fit(&gathered, places)?;
        tile.texels(job.gpu, &masked)
    })?;
    let [width, height] = job.source.btf().size();
    let texels = Map::new(width, height, texels)?;
    let rgb = |[r, g, b, _]: [f32; 4]| [r, g, b];
    let lobe = |index: usize| Lobe {
        specular: texels.map(|texel| rgb(texel.specular[index])),
        parameters: texels.map(|texel| texel.lobes[index]),
    };
    let svbrdf = Svbrdf {
        frame: candidate.frame,
        ambient: candidate.ambient,
        diffuse: texels.map(|texel| rgb(texel.diffuse)),
        lobes: (0..settings.lobes as usize).map(lobe).collect(),
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

/// The stages of every way of taking the surface, on one device.
pub(super) struct Stages {
    brdf_values: stage::BrdfValues,
    percentile: stage::Percentile,
    dark_samples: stage::DarkSamples,
    specular_residual: stage::SpecularResidual,
    lafortune_fit: stage::LafortuneFit,
    specular_scale: stage::SpecularScale,
    seen_surface: stage::SeenSurface,
    shading: stage::Shading,
    linear_refit: stage::LinearRefit,
    lobe_residual: stage::LobeResidual,
    radiance_error: stage::RadianceError,
}

impl Stages {
    /// Builds the kernels.
    pub fn new(gpu: &Gpu) -> Result<Self, PipelineError> {
        Ok(Self {
            brdf_values: stage::BrdfValues::new(gpu)?,
            percentile: stage::Percentile::new(gpu)?,
            dark_samples: stage::DarkSamples::new(gpu)?,
            specular_residual: stage::SpecularResidual::new(gpu)?,
            lafortune_fit: stage::LafortuneFit::new(gpu)?,
            specular_scale: stage::SpecularScale::new(gpu)?,
            seen_surface: stage::SeenSurface::new(gpu)?,
            shading: stage::Shading::new(gpu)?,
            linear_refit: stage::LinearRefit::new(gpu)?,
            lobe_residual: stage::LobeResidual::new(gpu)?,
            radiance_error: stage::RadianceError::new(gpu)?,
        })
    }
}

/// One way of taking the surface.
enum Model<'a> {
    Plane(PlaneFit<'a>),
    Local(LocalFit<'a>),
}

impl<'a> Model<'a> {
    /// Fitted to the given samples of the source.
    fn new(
        job: &Job<'a>, stages: &'a Stages, settings: &'a FitSettings, field: &'a HeightField, candidate: &Candidate,
        representative: Option<[usize; 2]>, samples: Vec<usize>,
    ) -> Result<Self, PipelineError> {
        Ok(match candidate.surface {
            SurfaceMode::Flat => Self::Plane(PlaneFit::flat(job, stages, settings, &samples)),
            SurfaceMode::Rough => Self::Plane(PlaneFit::rough(job, stages, settings, &samples, representative.unwrap_or_default())?),
            SurfaceMode::Local | SurfaceMode::Auto => Self::Local(LocalFit::new(job, stages, settings, field, candidate, samples)?),
        })
    }

    /// The source's samples that it is fitted to.
    fn samples(&self) -> &[usize] {
        match self {
            Self::Plane(plane) => plane.samples(),
            Self::Local(local) => local.samples(),
        }
    }

    /// Fits the texels of a tile with [`samples`](Self::samples), which stand at `places` (column, row).
    fn fit(&self, gathered: &Gathered, places: &[[u32; 2]]) -> Result<FittedTile, PipelineError> {
        match self {
            Self::Plane(plane) => plane.fit(&gathered.tile),
            Self::Local(local) => local.fit(&gathered.tile, places),
        }
    }
}

/// What is found for the texels of a tile.
struct FittedTile {
    /// ρ_d and ρ_s.
    coefficients: Refitted,
    /// `[lobe][texel]` (C_x, C_y, C_z, n).
    lobes: Buffer<[f32; 4]>,
    /// `[texel]` mean squared residuals without lobes and with them.
    objectives: Vec<[f32; 2]>,
    /// `[texel]` status of the first lobe's fit, and steps tried for all lobes.
    outcomes: Vec<[u32; 2]>,
}

impl FittedTile {
    /// With one lobe.
    fn of_lobe(gpu: &Gpu, coefficients: Refitted, fitted: FittedLobes) -> Result<Self, PipelineError> {
        let (objectives, outcomes) = (fitted.objectives.read(gpu)?, fitted.outcomes.read(gpu)?);
        Ok(Self { coefficients, lobes: fitted.lobes, objectives, outcomes })
    }

    fn texels(&self, gpu: &Gpu, masked: &[u32]) -> Result<Vec<Texel>, PipelineError> {
        let Refitted { diffuse, specular } = &self.coefficients;
        let (diffuse, specular, lobes) = (diffuse.read(gpu)?, specular.read(gpu)?, self.lobes.read(gpu)?);
        let count = masked.len();
        let of_lobes =
            |values: &[[f32; 4]], texel: usize| std::array::from_fn(|lobe| values.get(lobe * count + texel).copied().unwrap_or_default());
        let texel = |texel: usize| Texel {
            diffuse: diffuse[texel],
            specular: of_lobes(&specular, texel),
            lobes: of_lobes(&lobes, texel),
            objectives: self.objectives[texel],
            outcome: self.outcomes[texel],
            masked: masked[texel],
        };
        Ok((0..count).map(texel).collect())
    }
}

/// What is found for a texel.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Texel {
    diffuse: [f32; 4],
    specular: [[f32; 4]; MAX_LOBES],
    lobes: [[f32; 4]; MAX_LOBES],
    objectives: [f32; 2],
    outcome: [u32; 2],
    masked: u32,
}

/// The samples of `source` whose lights are high enough to divide by their cosine.
fn lit_samples(source: &dyn Source, settings: &FitSettings) -> Result<Vec<usize>, PipelineError> {
    let btf = source.btf();
    let lit: Vec<usize> = (0..btf.pairs().len()).filter(|&sample| btf.directions(sample).1.theta.cos() >= settings.min_cos_light).collect();
    if lit.is_empty() {
        return Err(PipelineError::OnlyGrazingLights {
            source_name: btf.name().to_owned(),
            samples: btf.pairs().len(),
            min_cos_light: settings.min_cos_light,
        });
    }
    Ok(lit)
}
