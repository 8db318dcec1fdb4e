//! `overpaint import`.

use std::path::PathBuf;

use clap::Args;

use super::{CliError, memory::MemoryArguments, output, reading::ReadingArguments, say, session::SessionArguments};
use crate::{io, pipeline};

/// Import a source into a dataset: one pass over its images, then quick to read in any part.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  overpaint import cloth/ -o cloth-btf.zarr
  overpaint fit cloth-btf.zarr -o cloth.zarr

A dataset is a Zarr group of linear half floats. Killed at any moment and run again, the import goes on where it was.")]
pub struct Import {
    /// The source: whatever `fit` takes
    source: PathBuf,
    /// The dataset to write, a Zarr group
    #[arg(short, long, value_name = "DATASET")]
    output: PathBuf,
    #[command(flatten)]
    memory: MemoryArguments,
    #[command(flatten)]
    reading: ReadingArguments,
}

impl Import {
    pub fn run(self, session: &SessionArguments) -> Result<(), CliError> {
        output::check_dataset(&self.output)?;
        let source = io::open_with(&self.source, &self.reading.options())?;
        let progress = session.on_host()?;
        let imported = pipeline::import(source.as_ref(), &self.output, self.memory.memory(None), &progress)?;
        let times = session.finish(progress)?;
        let kept = if imported.kept > 0 { format!(", {} of them of an earlier run", imported.kept) } else { String::new() };
        let invalid = if imported.invalid > 0 {
            format!(
                "\n{} values are no radiance (NaN, infinite or negative): they are kept, and what is computed leaves them out",
                imported.invalid
            )
        } else {
            String::new()
        };
        say(&format!("{times}{invalid}\nwrote {} ({} chunks{kept})", self.output.display(), imported.chunks))
    }
}
