//! A material's reconstructions against the source that it was recovered from: figures over all pairs, and an illustrated report.

mod elevations;
mod figures;
mod lpca;
mod measure;
mod pictures;
mod plot;
mod texel;

use std::{fs, path::Path, time::Instant};

use serde_json::{Value, json};

pub use figures::{AtElevation, AtElevations, Comparison, PairQuality, Quality, TexelError};

use self::figures::Figures;
use super::{Memory, PipelineError, Progress, Studio, report::Report};
use crate::{
    data::Material,
    gpu::Gpu,
    io::{self, IoError, Source},
    model::Appearance,
};

/// Names of the figures and of the report in a comparison's folder.
const JSON: &str = "compare.json";
const HTML: &str = "compare.html";

/// What the figures' file says it is.
const FORMAT: &str = "overpaint comparison";

/// How a material is compared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CompareSettings {
    /// What the reconstructions are made from.
    pub appearance: Appearance,
    /// Column and row of a texel whose measurement is kept.
    pub texel: Option<[usize; 2]>,
}

impl Default for CompareSettings {
    /// Reconstructions as [`Studio::reconstruct`] makes them of a measurement; no texel.
    fn default() -> Self {
        Self { appearance: Appearance::svbrdf(), texel: None }
    }
}

/// Compares the reconstruction of every pair of `source` with its original. The result does not depend on `memory`.
///
/// # Errors
/// [`PipelineError`] if source and material differ in size, there is no such texel, the material lacks what it is to be made from, the source
/// cannot be read, or the adapter fails.
pub fn compare(
    gpu: &Gpu, source: &dyn Source, material: &Material, settings: &CompareSettings, memory: Memory, progress: &Progress,
) -> Result<Comparison, PipelineError> {
    check_pair(source, material, settings)?;
    let studio = Studio::new(gpu)?;
    let start = Instant::now();
    let subject = studio.subject(material, settings.appearance, progress)?;
    let measured = measure::measure(&studio, &subject, source, settings, memory, progress)?;
    let btf = source.btf();
    let Figures { overall, masked, by_view_elevation, by_light_elevation, by_view_and_light_elevation, worst_pairs, worst_texels, texels } =
        Figures::new(btf, &measured.pairs, &measured.texels);
    Ok(Comparison {
        source: btf.name().to_owned(),
        size: btf.size(),
        appearance: settings.appearance,
        adapter: gpu.adapter().clone(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        seconds: start.elapsed().as_secs_f64(),
        masked,
        overall,
        by_view_elevation,
        by_light_elevation,
        by_view_and_light_elevation,
        worst_pairs,
        worst_texels,
        texels,
        texel: measured.texel,
        framed: measured.framed,
    })
}

/// Compares, and writes figures (`compare.json`), plot, pictures and a page that shows them (`compare.html`) into `folder`, which is made if
/// it is not there.
///
/// # Errors
/// As [`compare`], or if a file cannot be written.
pub fn compare_into(
    gpu: &Gpu, source: &dyn Source, material: &Material, settings: &CompareSettings, memory: Memory, folder: &Path, progress: &Progress,
) -> Result<Comparison, PipelineError> {
    check_comparison(folder)?;
    let comparison = compare(gpu, source, material, settings, memory, progress)?;
    let stage = progress.stage("report", 0, 0);
    fs::create_dir_all(folder).map_err(|source| IoError::Write { path: folder.to_owned(), source })?;
    let provenance = &material.provenance;
    let made = json!({
        "source": provenance.source, "adapter": provenance.adapter, "version": provenance.version, "settings": provenance.settings,
        "choice": material.choice, "lpca": material.lpca.as_ref().map(lpca::json),
    });
    // First, so that a run that is killed leaves a folder that is known.
    io::write(&folder.join(JSON), format!("{:#}\n", comparison.json(&made)).as_bytes())?;
    drop(stage);

    let mut report = Report::new(folder, &format!("{}: original and reconstruction", comparison.source), &comparison.introduction());
    let studio = Studio::new(gpu)?;
    pictures::Job { source, material, settings, comparison: &comparison, studio: &studio, progress }.write(&mut report)?;
    report.finish(HTML, &progress.report())?;
    Ok(comparison)
}

/// Checks that [`compare_into`] may write into `folder`: nothing is there, an empty folder, or one that holds a comparison.
///
/// # Errors
/// [`IoError::Occupied`] if something else stands there, [`IoError::Read`] if it cannot be looked at.
pub fn check_comparison(folder: &Path) -> Result<(), IoError> {
    let occupied = |found: String| Err(IoError::Occupied { path: folder.to_owned(), found });
    if folder.symlink_metadata().is_err() {
        return Ok(());
    }
    if !folder.is_dir() {
        return occupied("it is there and no folder".to_owned());
    }
    let mut entries = fs::read_dir(folder).map_err(|source| IoError::Read { file: folder.display().to_string(), source })?;
    let is_ours = || {
        let figures: Option<Value> = fs::read(folder.join(JSON)).ok().and_then(|bytes| serde_json::from_slice(&bytes).ok());
        figures.is_some_and(|figures| figures["format"] == FORMAT)
    };
    if entries.next().is_none() || is_ours() {
        Ok(())
    } else {
        occupied(format!("it is there and no overpaint comparison (no {JSON} of one)"))
    }
}

/// Checks that source and material go together and have the texel asked for.
fn check_pair(source: &dyn Source, material: &Material, settings: &CompareSettings) -> Result<(), PipelineError> {
    let btf = source.btf();
    if material.painted.is_some() {
        return Err(PipelineError::Painted);
    }
    if btf.size() != material.size() {
        return Err(PipelineError::SizesDiffer {
            source_name: btf.name().to_owned(),
            source_size: btf.size(),
            material_size: material.size(),
        });
    }
    let [width, height] = btf.size();
    match settings.texel {
        Some([column, row]) if column >= width || row >= height => Err(PipelineError::NoSuchTexel { column, row, width, height }),
        _ => Ok(()),
    }
}

/// The channels, if they are a radiance.
fn radiance(channels: [f32; 3]) -> Option<[f32; 3]> {
    Some(channels).filter(|channels| channels.iter().all(|value| value.is_finite() && *value >= 0.0))
}
