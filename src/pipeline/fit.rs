//! A source in, a material out.

use super::{PipelineError, Progress, geometry, reflectance};
use crate::{
    data::{Material, Provenance},
    gpu::Gpu,
    io::Source,
    model::FitSettings,
};

/// Recovers height, normals and per-texel reflectance of a source.
///
/// Works in tiles sized from the adapter's limits, on images decoded once for as many tiles as 1 GiB of codes holds.
///
/// # Errors
/// [`PipelineError`] if the source cannot be read, has too few lights, or the adapter fails.
pub fn fit(gpu: &Gpu, source: &dyn Source, settings: &FitSettings, progress: &Progress) -> Result<Material, PipelineError> {
    let geometry = geometry::recover(gpu, source, settings, progress)?;
    let (svbrdf, fit) = reflectance::recover(gpu, source, settings, progress)?;
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
            transfer: btf.transfer(),
            adapter: gpu.adapter().name.clone(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            settings: *settings,
        },
    };
    Ok(material.checked()?)
}
