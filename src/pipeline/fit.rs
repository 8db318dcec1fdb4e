//! A source in, a material out.

use serde_json::{Value, json};

use super::{Memory, PipelineError, Progress, geometry, lpca, reflectance, tiles::Job};
use crate::{
    data::{Candidate, Material, Provenance},
    gpu::Gpu,
    io::{Source, Unfinished},
    model::FitSettings,
};

/// Recovers height, normals and per-texel reflectance of a source, within the default [`Memory`]; see [`fit_within`].
///
/// # Errors
/// [`PipelineError`] if the source cannot be read, has too few lights, a setting is out of range, or the adapter fails.
pub fn fit(gpu: &Gpu, source: &dyn Source, settings: &FitSettings, progress: &Progress) -> Result<Material, PipelineError> {
    fit_within(gpu, source, settings, Memory::default(), None, progress)
}

/// Recovers height, normals and per-texel reflectance of a source, and its local PCA.
///
/// Works in tiles sized from the adapter's limits and `memory`, and reads ahead of the adapter; the result does not depend on them. With
/// `unfinished`, begun with [`fit_job`], finished tiles are kept there as they come, and those that an earlier run kept are not done again.
///
/// # Errors
/// [`PipelineError`] if the source cannot be read, has too few lights, a setting is out of range, a tile cannot be kept, or the adapter fails.
pub fn fit_within(
    gpu: &Gpu, source: &dyn Source, settings: &FitSettings, memory: Memory, unfinished: Option<&Unfinished>, progress: &Progress,
) -> Result<Material, PipelineError> {
    check_fit(gpu, source, settings)?;
    let job = Job { gpu, source, memory, unfinished, progress };
    let geometry = geometry::recover(&job, settings)?;
    let stages = reflectance::Stages::new(gpu)?;
    let choice = reflectance::choose(&job, &stages, settings, &geometry)?;
    let Candidate { height_scale, height_level, .. } = choice.chosen();
    let geometry = geometry.with_height(&job, height_scale, height_level)?;
    let (svbrdf, fit) = reflectance::recover(&job, &stages, settings, &geometry.field, &choice)?;
    let lpca = settings.lpca.map(|settings| lpca::recover(&job, &settings)).transpose()?;
    let material = Material {
        height: geometry.height,
        normal: geometry.normal,
        normal_measured: geometry.normal_measured,
        albedo: geometry.albedo,
        svbrdf,
        lpca,
        painted: None,
        fit,
        choice,
        provenance: provenance(gpu, source, settings),
    };
    Ok(material.checked()?)
}

/// Checks that `settings` are in range and fit the source and the adapter: what [`fit_within`] asks first, for whoever begins a job before it.
///
/// # Errors
/// [`PipelineError`] if a setting is out of range, the representative texel outside the plane, or the local PCA larger than the adapter binds.
pub fn check_fit(gpu: &Gpu, source: &dyn Source, settings: &FitSettings) -> Result<(), PipelineError> {
    settings.checked()?;
    if let Some(settings) = &settings.lpca {
        lpca::check(gpu, source, settings)?;
    }
    let [width, height] = source.btf().size();
    match settings.representative {
        Some([column, row]) if column >= width || row >= height => Err(PipelineError::NoSuchTexel { column, row, width, height }),
        _ => Ok(()),
    }
}

/// All that the result of a fit depends on, for [`Unfinished::begin`].
#[must_use]
pub fn fit_job(gpu: &Gpu, source: &dyn Source, settings: &FitSettings) -> Value {
    json!({
        "job": "fit",
        "files of the source": source.fingerprint(),
        "size": source.btf().size(),
        "source, settings, adapter and version": provenance(gpu, source, settings),
    })
}

fn provenance(gpu: &Gpu, source: &dyn Source, settings: &FitSettings) -> Provenance {
    let btf = source.btf();
    Provenance {
        source: btf.name().to_owned(),
        views: btf.views().to_vec(),
        lights: btf.lights().to_vec(),
        samples: btf.pairs().len(),
        grid: btf.grid().map(str::to_owned),
        encoding: *btf.encoding(),
        adapter: gpu.adapter().name.clone(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        settings: *settings,
    }
}
