//! `overpaint adapters`.

use clap::Args;

use super::{CliError, say};
use crate::gpu::{AdapterSummary, GpuError, adapters};

/// List the adapters of this machine, the default first.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  overpaint adapters\n  overpaint --adapter llvmpipe demo")]
pub struct Adapters {}

impl Adapters {
    pub fn run(self) -> Result<(), CliError> {
        let found = adapters();
        if found.is_empty() {
            return Err(GpuError::NoAdapter.into());
        }
        say(&found.iter().map(describe).collect::<Vec<_>>().join("\n\n"))
    }
}

fn describe(adapter: &AdapterSummary) -> String {
    let mebibytes = |bytes: u64| bytes >> 20;
    let timestamps = if adapter.timestamps { "yes" } else { "no" };
    [
        adapter.name.clone(),
        format!("  driver             {}", adapter.driver),
        format!("  type               {}, {}", adapter.kind, adapter.backend),
        format!("  storage binding    {} MiB", mebibytes(adapter.max_storage_binding)),
        format!("  buffer             {} MiB", mebibytes(adapter.max_buffer)),
        format!("  storage buffers    {} a stage", adapter.max_storage_buffers),
        format!("  workgroup          {} invocations, {} KiB", adapter.max_invocations, adapter.max_workgroup_storage >> 10),
        format!("  timestamps         {timestamps}"),
    ]
    .join("\n")
}
