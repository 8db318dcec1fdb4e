//! How much a job may hold, as typed.

use bytesize::ByteSize;
use clap::Args;

use crate::pipeline::Memory;

/// The least that makes sense: below it, a single texel of a large dataset may not fit.
const LEAST: ByteSize = ByteSize::mib(1);

/// Bounds of a job's memory.
#[derive(Debug, Clone, Copy, Args)]
pub struct MemoryArguments {
    /// Hold at most this much of a source in memory, such as 2GiB [default: half of what is free]
    #[arg(long, value_name = "BYTES", value_parser = bytes)]
    memory: Option<ByteSize>,
}

/// Bounds of what a job holds on the adapter.
#[derive(Debug, Clone, Copy, Args)]
pub struct AdapterMemoryArguments {
    /// Hold at most this much of a source on the adapter, such as 256MiB [default: 1GiB]
    #[arg(long, value_name = "BYTES", value_parser = bytes)]
    vram: Option<ByteSize>,
}

impl MemoryArguments {
    /// What was typed, and the default for what was not.
    pub fn memory(self, adapter: Option<AdapterMemoryArguments>) -> Memory {
        let mut memory = Memory::half_of_free();
        if let Some(host) = self.memory {
            memory.host = usize::try_from(host.as_u64()).unwrap_or(usize::MAX);
        }
        if let Some(vram) = adapter.and_then(|adapter| adapter.vram) {
            memory.adapter = vram.as_u64();
        }
        memory
    }
}

/// A size of 1 byte or more.
pub fn size(text: &str) -> Result<ByteSize, String> {
    text.parse().ok().filter(|bytes: &ByteSize| bytes.as_u64() > 0).ok_or_else(|| "expected a size, such as 8MiB".to_owned())
}

fn bytes(text: &str) -> Result<ByteSize, String> {
    let expected = || format!("expected an amount of memory of at least {LEAST}, such as 2GiB or 256MiB");
    text.parse().ok().filter(|bytes| *bytes >= LEAST).ok_or_else(expected)
}
