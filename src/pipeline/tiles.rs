//! Cutting a source into tiles that fit the adapter and bands that fit the host, and running stages on them.

use std::ops::Range;

use half::f16;

use super::{PipelineError, Progress};
use crate::{
    data::{Block, OCTET},
    gpu::{Gpu, Recorder},
    io::Source,
    stage::{LafortuneFit, Tile},
};

/// What may be held at once.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Memory {
    /// Bytes of decoded images on the host.
    pub host: usize,
    /// Bytes of the largest array of a tile on the adapter. An adapter's own limit holds as well.
    pub adapter: u64,
}

impl Default for Memory {
    /// 1 GiB, and arrays of 256 MiB: larger tiles gain nothing.
    fn default() -> Self {
        Self { host: 1 << 30, adapter: 256 << 20 }
    }
}

/// Texels of a tile with `samples` samples, so that its largest array fits: the halves `[channel][octet][texel]`, or with few
/// samples what a stage keeps of each texel.
fn tile_texels(gpu: &Gpu, memory: Memory, samples: usize) -> usize {
    let halves = 3 * samples.next_multiple_of(OCTET) * size_of::<f16>();
    let texel = halves.max(LafortuneFit::STATE_BYTES) as u64;
    usize::try_from(gpu.max_array_bytes().min(memory.adapter) / texel).unwrap_or(usize::MAX).max(1)
}

/// Calls `tile(texels, halves)` for each tile of the source, with the radiance `[sample][channel][texel]` of the given samples.
pub(super) fn for_each_tile(
    gpu: &Gpu, source: &dyn Source, samples: &[usize], memory: Memory, progress: &Progress,
    mut tile: impl FnMut(Range<usize>, &[f16]) -> Result<(), PipelineError>,
) -> Result<(), PipelineError> {
    let btf = source.btf();
    let [width, height] = btf.size();
    let texels = btf.texels();
    let tile_texels = tile_texels(gpu, memory, samples.len()).min(texels);
    let rows = (memory.host / (samples.len() * width * 6)).clamp(1, height);
    progress.expect(height.div_ceil(rows) * samples.len());
    for row in (0..height).step_by(rows) {
        let block = Block { column: 0, row, width, height: rows.min(height - row) };
        let mut radiance = vec![f16::ZERO; samples.len() * 3 * block.texels()];
        let stage = progress.stage("read", block.texels(), samples.len());
        source.read(samples, block, &mut radiance, &|samples| progress.advance(samples))?;
        drop(stage);
        for start in (0..block.texels()).step_by(tile_texels) {
            let inside = start..(start + tile_texels).min(block.texels());
            let part: Vec<f16> = radiance.chunks_exact(block.texels()).flat_map(|row| &row[inside.clone()]).copied().collect();
            tile(row * width + inside.start..row * width + inside.end, &part)?;
        }
    }
    Ok(())
}

/// Octets of radiance `[sample][channel][texel]`.
pub(super) fn octets(gpu: &Gpu, radiance: &[f16], samples: usize, texels: usize) -> Result<Tile, PipelineError> {
    let octets = samples.div_ceil(OCTET);
    let mut values = vec![[f16::ZERO; OCTET]; 3 * octets * texels];
    for (index, &half) in radiance.iter().enumerate() {
        let (texel, channel, sample) = (index % texels, index / texels % 3, index / texels / 3);
        values[(channel * octets + sample / OCTET) * texels + texel][sample % OCTET] = half;
    }
    Ok(Tile { values: gpu.upload("radiance", &values)?, texels, samples })
}

/// Records a stage, runs it and notes its time.
pub(super) fn run<T, E>(
    gpu: &Gpu, progress: &Progress, name: &'static str, [texels, samples]: [usize; 2],
    record: impl FnOnce(&mut Recorder<'_>) -> Result<T, E>,
) -> Result<T, PipelineError>
where
    PipelineError: From<E>,
{
    let stage = progress.stage(name, texels, samples);
    let mut recorder = gpu.recorder();
    let result = record(&mut recorder)?;
    stage.gpu(&gpu.submit(recorder).wait(gpu)?);
    Ok(result)
}
