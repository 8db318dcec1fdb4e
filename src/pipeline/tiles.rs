//! Cutting a source into tiles that fit the adapter and bands that fit the host, and running stages on them.

use std::ops::Range;

use rayon::prelude::*;

use super::{PipelineError, Progress};
use crate::{
    data::OCTET,
    gpu::{Gpu, Recorder},
    io::Source,
    stage::LafortuneFit,
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
    let halves = 3 * samples.next_multiple_of(OCTET) * size_of::<half::f16>();
    let texel = halves.max(LafortuneFit::STATE_BYTES) as u64;
    usize::try_from(gpu.max_array_bytes().min(memory.adapter) / texel).unwrap_or(usize::MAX).max(1)
}

/// Calls `tile(texels, codes)` for each tile of the source, with the codes `[sample][texel]` of the given samples. Each image is decoded
/// once a band of tiles: once in all where the band holds the whole plane.
pub(super) fn for_each_tile(
    gpu: &Gpu, source: &dyn Source, samples: &[usize], memory: Memory, progress: &Progress,
    mut tile: impl FnMut(Range<usize>, &[u32]) -> Result<(), PipelineError>,
) -> Result<(), PipelineError> {
    let texels = source.btf().texels();
    let tile_texels = tile_texels(gpu, memory, samples.len()).min(texels);
    let tiles_a_band = (memory.host / (samples.len() * tile_texels * size_of::<u32>())).max(1);
    let band_texels = (tiles_a_band * tile_texels).min(texels);
    progress.expect(texels.div_ceil(band_texels) * samples.len());
    for start in (0..texels).step_by(band_texels) {
        let band = start..(start + band_texels).min(texels);
        let codes = decode_band(source, samples, band.clone(), progress)?;
        for start in band.clone().step_by(tile_texels) {
            let texels = start..(start + tile_texels).min(band.end);
            if texels == band {
                tile(texels, &codes)?;
            } else {
                let inside = texels.start - band.start..texels.end - band.start;
                let rows = codes.chunks_exact(band.len());
                let part: Vec<u32> = rows.flat_map(|row| &row[inside.clone()]).copied().collect();
                tile(texels, &part)?;
            }
        }
    }
    Ok(())
}

/// Decodes the given samples' images, on all cores, and keeps the codes `[sample][texel]` of a band of texels.
fn decode_band(source: &dyn Source, samples: &[usize], band: Range<usize>, progress: &Progress) -> Result<Vec<u32>, PipelineError> {
    let _stage = progress.stage("image_decode", band.len(), samples.len());
    let mut codes = vec![0_u32; samples.len() * band.len()];
    codes.par_chunks_exact_mut(band.len()).zip(samples).try_for_each(|(row, &sample)| {
        let image = source.decode(sample)?;
        for (code, pixel) in row.iter_mut().zip(&image[band.clone()]) {
            *code = u32::from_le_bytes(*pixel);
        }
        progress.advance(1);
        Ok::<(), PipelineError>(())
    })?;
    Ok(codes)
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
