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
        if let Some(timings) = &self.timings {
            output::check_file(timings)?;
        }
        let gpu = Gpu::open(self.adapter.as_deref())?;
        let progress = Progress::observed(gpu.adapter(), bar::observer());
        Ok(Session { gpu, progress, timings: self.timings.clone() })
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
        let table = self.progress.report();
        // The bar goes before anything else is printed.
        drop(self.progress);
        if let Some(path) = self.timings {
            let json = serde_json::to_string_pretty(&table);
            let json = json.map_err(|error| CliError::Write { path: path.clone(), source: error.into() })?;
            io::write(&path, (json + "\n").as_bytes())?;
        }
        Ok(table)
    }
}
