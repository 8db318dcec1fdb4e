//! A source in, a dataset out: one pass over what the source stores, in bounded memory, resumable chunk by chunk.

use std::path::Path;

use half::f16;
use rayon::prelude::*;

use super::{Memory, PipelineError, Progress};
use crate::{
    data::Block,
    io::{Source, dataset::DatasetWriter},
};

/// What an import did.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Imported {
    /// Chunks of the dataset.
    pub chunks: usize,
    /// Those that an earlier, unfinished run had written.
    pub kept: usize,
    /// Values that are no radiance (NaN, infinite or negative), among those read by this run.
    pub invalid: usize,
}

/// Makes the dataset `target` of `source`. Killed at any moment and run again, it goes on where it was, and the result is the same.
///
/// A source of pictures is read view by view, one view in memory; where even one is more than `memory.host`, in bands of tiles. A source
/// stored in blocks is read block by block with all samples. Writing works on all cores, as reading does.
///
/// # Errors
/// [`PipelineError::Source`] if the source cannot be read or the dataset not be written, or if another job on `target` is unfinished.
pub fn import(source: &dyn Source, target: &Path, memory: Memory, progress: &Progress) -> Result<Imported, PipelineError> {
    let btf = source.btf();
    let views = btf.views().len();
    let writer = DatasetWriter::begin(target, btf, &source.fingerprint())?;
    let samples: Vec<usize> = (0..btf.pairs().len()).collect();
    let of_view: Vec<Vec<usize>> =
        (0..views).map(|view| samples.iter().copied().filter(|&sample| btf.pairs()[sample].view == view).collect()).collect();
    let tiles: Vec<Block> = writer.tiles().collect();
    let (mut kept, mut invalid) = (0, 0);
    progress.expect(views * tiles.len());

    // The views and tiles that are read at once.
    let groups: Vec<(Vec<usize>, &[Block])> = match source.chunk() {
        None => {
            let largest = of_view.iter().map(Vec::len).max().unwrap_or(0);
            let bands = bands(&tiles, largest, memory);
            (0..views).flat_map(|view| bands.iter().map(move |&band| (vec![view], band))).collect()
        }
        Some(_) => tiles.chunks(1).map(|tile| ((0..views).collect(), tile)).collect(),
    };
    let mut radiance = Vec::new();
    for (views, tiles) in groups {
        let stage = progress.stage("check", 0, 0);
        let mut missing: Vec<(usize, Vec<Block>)> = Vec::new();
        for view in views {
            let of_view: Vec<Block> = tiles.par_iter().copied().filter(|&tile| !writer.has(view, tile)).collect();
            kept += tiles.len() - of_view.len();
            progress.advance(tiles.len() - of_view.len());
            if !of_view.is_empty() {
                missing.push((view, of_view));
            }
        }
        drop(stage);
        if missing.is_empty() {
            continue;
        }
        let block = tiles.iter().copied().reduce(|a, b| a.hull(&b)).unwrap_or(Block::whole(btf.size()));
        let samples: Vec<usize> = missing.iter().flat_map(|(view, _)| &of_view[*view]).copied().collect();
        radiance.clear();
        radiance.resize(samples.len() * 3 * block.texels(), f16::ZERO);
        let stage = progress.stage("read", block.texels(), samples.len());
        source.read(&samples, block, &mut radiance, &|_| {})?;
        drop(stage);
        let _stage = progress.stage("write", block.texels(), samples.len());
        invalid += radiance.par_iter().filter(|value| is_invalid(**value)).count();
        let mut rest = radiance.as_slice();
        for (view, tiles) in missing {
            let (of_view, after) = rest.split_at(of_view[view].len() * 3 * block.texels());
            writer.put(view, &tiles, block, of_view)?;
            progress.advance(tiles.len());
            rest = after;
        }
    }
    writer.finish()?;
    Ok(Imported { chunks: views * tiles.len(), kept, invalid })
}

/// Rows of tiles, as many in a band as the host may hold of one view.
fn bands(tiles: &[Block], samples: usize, memory: Memory) -> Vec<&[Block]> {
    let rows: Vec<&[Block]> = tiles.chunk_by(|a, b| a.row == b.row).collect();
    let (row_tiles, row_texels) = rows.first().map_or((1, 1), |row| (row.len(), row.iter().map(Block::texels).sum()));
    let rows_at_once = (memory.host / (samples * 3 * size_of::<f16>() * row_texels).max(1)).max(1);
    tiles.chunks(rows_at_once * row_tiles).collect()
}

/// Whether a value is no radiance: NaN, infinite or negative; negative zero is zero.
fn is_invalid(value: f16) -> bool {
    !value.is_finite() || value < f16::ZERO
}
