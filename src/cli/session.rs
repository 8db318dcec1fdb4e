//! What every computing command shares: the adapter, the progress and the timings.

use std::path::PathBuf;

use clap::Args;

use super::{CliError, bar, output};
use crate::{
    gpu::Gpu,
    io,
    pipeline::{Progress, StageTable},
};

/// Arguments of every computing command.
#[derive(Debug, Args)]
pub struct SessionArguments {
    /// Use the first adapter whose name contains NAME (`overpaint adapters` lists them)
    #[arg(long, global = true, value_name = "NAME")]
    adapter: Option<String>,
    /// Write the stages with their times to FILE, as JSON
    #[arg(long, global = true, value_name = "FILE")]
    timings: Option<PathBuf>,
}

impl SessionArguments {
    /// Whether any was typed.
    pub fn is_given(&self) -> bool {
        self.adapter.is_some() || self.timings.is_some()
    }

    /// Checks that the timings can be written, then opens the adapter.
    pub fn open(&self) -> Result<Session, CliError> {
        self.check_timings()?;
        let gpu = Gpu::open(self.adapter.as_deref())?;
        let progress = Progress::observed(gpu.adapter(), bar::observer());
        Ok(Session { gpu, progress, timings: self.timings.clone() })
    }

    /// The progress of a job that needs no adapter; [`Self::finish`] ends it.
    pub fn on_host(&self) -> Result<Progress, CliError> {
        self.check_timings()?;
        Ok(Progress::on_host(bar::observer()))
    }

    /// Ends the progress of a job, writes the timings if they were asked for, and returns them.
    pub fn finish(&self, progress: Progress) -> Result<StageTable, CliError> {
        finish(progress, self.timings.clone())
    }

    fn check_timings(&self) -> Result<(), CliError> {
        self.timings.as_deref().map_or(Ok(()), output::check_file)
    }
}

/// An open adapter and the progress of the job that runs on it.
#[derive(Debug)]
pub struct Session {
    /// The adapter.
    pub gpu: Gpu,
    /// The job's progress.
    pub progress: Progress,
    timings: Option<PathBuf>,
}

impl Session {
    /// Ends the progress, writes the timings if they were asked for, and returns them.
    pub fn finish(self) -> Result<StageTable, CliError> {
        finish(self.progress, self.timings)
    }
}

fn finish(progress: Progress, timings: Option<PathBuf>) -> Result<StageTable, CliError> {
    let table = progress.report();
    // The bar goes before anything else is printed.
    drop(progress);
    if let Some(path) = timings {
        let json = serde_json::to_string_pretty(&table);
        let json = json.map_err(|error| CliError::Write { path: path.clone(), source: error.into() })?;
        io::write(&path, (json + "\n").as_bytes())?;
    }
    Ok(table)
}
