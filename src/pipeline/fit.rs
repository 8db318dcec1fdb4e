//! A source in, a material out.

use super::{Memory, PipelineError, Progress, geometry, reflectance};
use crate::{
    data::{Material, Provenance},
    gpu::Gpu,
    io::Source,
    model::FitSettings,
};

/// Recovers height, normals and per-texel reflectance of a source, within the default [`Memory`]; see [`fit_within`].
///
/// # Errors
/// [`PipelineError`] if the source cannot be read, has too few lights, a setting is out of range, or the adapter fails.
pub fn fit(gpu: &Gpu, source: &dyn Source, settings: &FitSettings, progress: &Progress) -> Result<Material, PipelineError> {
    fit_within(gpu, source, settings, Memory::default(), progress)
}

/// Recovers height, normals and per-texel reflectance of a source.
///
/// Works in tiles sized from the adapter's limits and `memory`; the result does not depend on them. Images are decoded once for as many
/// tiles as the host holds, those of the zenith view once more.
///
/// # Errors
/// [`PipelineError`] if the source cannot be read, has too few lights, or the adapter fails.
pub fn fit_within(
    gpu: &Gpu, source: &dyn Source, settings: &FitSettings, memory: Memory, progress: &Progress,
) -> Result<Material, PipelineError> {
    settings.checked()?;
    let geometry = geometry::recover(gpu, source, settings, memory, progress)?;
    let (svbrdf, fit) = reflectance::recover(gpu, source, settings, memory, progress)?;
    let btf = source.btf();
    let material = Material {
        height: geometry.height,
        normal: geometry.normal,
        normal_measured: geometry.normal_measured,
        albedo: geometry.albedo,
        svbrdf,
        fit,
        provenance: Provenance {
            source: btf.name().to_owned(),
            views: btf.views().to_vec(),
            lights: btf.lights().to_vec(),
            samples: btf.pairs().len(),
            grid: btf.grid().map(str::to_owned),
            encoding: *btf.encoding(),
            adapter: gpu.adapter().name.clone(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            settings: *settings,
        },
    };
    Ok(material.checked()?)
}
