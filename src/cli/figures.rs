//! `overpaint figures`.

use std::{fs, path::PathBuf};

use clap::Args;

use super::{CliError, output, say, session::SessionArguments};
use crate::{io, pipeline};

/// Make the figures of painted materials that the thesis has, as one illustrated page.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  overpaint figures -o figures
  overpaint figures cloth.zarr blocks.zarr -o figures

Each material has its own figures: the whole sample under watercolours and under oils (4.3, 4.4), and paint against alpha blending (4.5, 4.6).")]
pub struct Figures {
    /// The materials, as `fit` wrote them; without one the sample inside this program, which is fitted first
    materials: Vec<PathBuf>,
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
        for path in &self.materials {
            let name = path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
            materials.push((name, io::material::load(path)?));
        }
        let session = session.open()?;
        if materials.is_empty() {
            materials.push((pipeline::SAMPLE_NAME.to_owned(), pipeline::fit_sample(&session.gpu, &session.progress)?));
        }
        pipeline::figures(&session.gpu, &materials, &self.output, &session.progress)?;
        let times = session.finish()?;
        say(&format!("{times}\nwrote {}", page.display()))
    }
}
