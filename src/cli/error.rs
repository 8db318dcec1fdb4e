//! What ends a command early, and its exit code.

use std::{error::Error, io::Write, path::PathBuf};

use crate::{gpu::GpuError, io::IoError, pipeline::PipelineError};

/// What can end a command.
#[derive(Debug, thiserror::Error)]
pub enum CliError {
    /// Arguments that cannot be used; or a request for help or the version.
    #[error(transparent)]
    Usage(#[from] clap::Error),
    /// No adapter, or trouble with it.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// A file that cannot be read or written.
    #[error(transparent)]
    Io(#[from] IoError),
    /// A job that failed.
    #[error(transparent)]
    Pipeline(#[from] PipelineError),
    /// A result that could not be written where it was asked for; found before the work.
    #[error("{path} cannot be written: {reason}", path = path.display())]
    Output {
        /// The result's path.
        path: PathBuf,
        /// Why, and what to do.
        reason: String,
    },
    /// A file that the command line writes itself.
    #[error("{path} could not be written; check that its folder may be written and the disk has room", path = path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// Standard output is closed or full.
    #[error("standard output could not be written; check where it goes: a full disk or a closed file")]
    Stdout {
        /// The system's reason.
        source: std::io::Error,
    },
}

impl CliError {
    /// 2 for wrong usage, 1 for a failure, 0 for help and version.
    #[must_use]
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Usage(error) if error.exit_code() == 0 => 0,
            Self::Usage(_) => 2,
            _ => 1,
        }
    }

    /// Prints the error with its causes, once: on stderr, help and version on stdout.
    pub fn print(&self) {
        // Nobody is left to tell if the stream is closed.
        match self {
            Self::Usage(error) => error.print().ok(),
            _ => writeln!(std::io::stderr(), "error: {}", causes(self)).ok(),
        };
    }
}

/// The error's message and those of its causes; a cause that the message before already ends with is left out.
fn causes(error: &dyn Error) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        let message = error.to_string();
        if !text.ends_with(&message) {
            text = format!("{text}: {message}");
        }
        cause = error.source();
    }
    text
}
