//! `overpaint figures`.

use std::{
    fs,
    path::{Path, PathBuf},
};

use clap::Args;

use super::{CliError, model::misplaced, output, say, session::SessionArguments};
use crate::{
    io,
    pipeline::{self, FigureSettings, Pictured},
};

/// Make the figures of painted materials that the thesis has, as one illustrated page.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  overpaint figures -o figures
  overpaint figures cloth.zarr blocks.zarr -o figures

Each material has its own figures: what was measured and recovered (3.2, 4.1, 4.2), if its source is named; the whole sample under watercolours
and under oils (4.3, 4.4), and paint against alpha blending (4.5, 4.6); and on models what the bare part is made from (4.7, 4.8), patterns and
refractive indices (4.9 to 4.12), thickness (4.13, 4.14) and layers (4.15, 4.16).")]
pub struct Figures {
    /// The materials, as `fit` wrote them; without one the sample inside this program, which is fitted first
    materials: Vec<PathBuf>,
    /// The BTF that a material was recovered from; of several materials, as many times and in their order
    #[arg(long, value_name = "SOURCE")]
    source: Vec<PathBuf>,
    /// A model to show painted, beside the built-in ones: .obj, .gltf or .glb; may be given several times
    #[arg(long, value_name = "MESH")]
    mesh: Vec<PathBuf>,
    /// Columns of each picture
    #[arg(long, value_name = "N", default_value_t = FigureSettings::default().side, value_parser = clap::value_parser!(u32).range(64..=4096))]
    side: u32,
    /// Rays a pixel of the models
    #[arg(long, value_name = "N", default_value_t = FigureSettings::default().rays, value_parser = clap::value_parser!(u32).range(1..=4096))]
    spp: u32,
    /// Folder for figures.html and its pictures
    #[arg(short, long, value_name = "DIR", default_value = "figures")]
    output: PathBuf,
}

impl Figures {
    pub fn run(self, session: &SessionArguments) -> Result<(), CliError> {
        fs::create_dir_all(&self.output).map_err(|source| CliError::Write { path: self.output.clone(), source })?;
        let page = self.output.join(pipeline::FIGURES);
        output::check_file(&page)?;
        let mut materials = Vec::new();
        if !self.source.is_empty() && self.source.len() != self.materials.len() {
            return Err(misplaced("there must be one --source for each material, or none"));
        }
        let name = |path: &Path| path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
        for (index, path) in self.materials.iter().enumerate() {
            let source = self.source.get(index).map(|source| io::open(source)).transpose()?;
            materials.push(Pictured { name: name(path), material: io::material::load(path)?, source });
        }
        let mut models = Vec::new();
        for path in &self.mesh {
            let loaded = io::mesh::load(path)?;
            for warning in &loaded.warnings {
                eprintln!("warning: {warning}");
            }
            models.push((name(path), loaded.mesh));
        }
        let session = session.open()?;
        if materials.is_empty() {
            materials.push(Pictured::sample(&session.gpu, &session.progress)?);
        }
        pipeline::figures(
            &session.gpu,
            &materials,
            models,
            FigureSettings { side: self.side, rays: self.spp, ..FigureSettings::default() },
            &self.output,
            &session.progress,
        )?;
        let times = session.finish()?;
        say(&format!("{times}\nwrote {}", page.display()))
    }
}
