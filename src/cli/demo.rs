//! `overpaint demo`.

use std::{fs, path::PathBuf};

use clap::Args;

use super::{CliError, output, say, session::SessionArguments};
use crate::pipeline;

/// Fit, compare and paint the sample inside this program, and write an illustrated report.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  overpaint demo\n  overpaint demo -o weave --timings weave.json")]
pub struct Demo {
    /// Folder for report.html, its pictures and the material
    #[arg(short, long, value_name = "DIR", default_value = "demo")]
    output: PathBuf,
}

impl Demo {
    pub fn run(self, session: &SessionArguments) -> Result<(), CliError> {
        fs::create_dir_all(&self.output).map_err(|source| CliError::Write { path: self.output.clone(), source })?;
        output::check_file(&self.output.join(pipeline::REPORT))?;
        let session = session.open()?;
        pipeline::demo(&session.gpu, &self.output, &session.progress)?;
        let times = session.finish()?;
        say(&format!("{times}\nwrote {}", self.output.join(pipeline::REPORT).display()))
    }
}
