//! Cutting a source into blocks that the host holds and tiles that the adapter works on, and running stages on them.
//!
//! While the adapter works on the tiles of one block, another thread reads the next. A texel's result does not depend on the tile it comes
//! in, so finished tiles are kept under the texels they cover: a run that was killed takes them up again with whatever memory it has then.

use std::{ops::Range, sync::mpsc, thread};

use bytemuck::Pod;
use half::f16;

use super::{Memory, PipelineError, Progress};
use crate::{
    data::{Block, OCTET},
    gpu::{Gpu, Recorder},
    io::{Source, Unfinished},
    stage::{Gather, Gathered, LafortuneFit, count},
};

/// Bytes that a texel's samples take on the adapter at most, in units of the halves of its three channels: as they are uploaded, the copy
/// that the driver makes of them, and radiance; later radiance, reflectance and its residual, which are fewer.
const COPIES: usize = 3;

/// Threads that the largest adapters run at once, a texel each. Beyond it progress is seen and kept less often for nothing, and the list of
/// texels whose fit still runs, which one workgroup makes, takes its time.
const MAX_TILE_TEXELS: usize = 1 << 17;

/// What is common to all tiles of a job.
#[derive(Clone, Copy)]
pub(super) struct Job<'a> {
    pub gpu: &'a Gpu,
    pub source: &'a dyn Source,
    pub memory: Memory,
    /// Where finished tiles are kept, if anywhere.
    pub unfinished: Option<&'a Unfinished>,
    pub progress: &'a Progress,
}

impl Job<'_> {
    /// Texels of a tile with `samples` samples.
    fn tile_texels(&self, samples: usize) -> usize {
        let halves = texel_bytes(samples);
        let array = halves.max(LafortuneFit::STATE_BYTES).max(self.seen_bytes()) as u64;
        let texels = (self.gpu.max_array_bytes() / array).min(self.memory.adapter / self.working_bytes(samples));
        usize::try_from(texels).unwrap_or(usize::MAX).clamp(1, MAX_TILE_TEXELS)
    }

    /// Normal and place of the point that each view sees, bytes a texel.
    fn seen_bytes(&self) -> usize {
        self.source.btf().views().len() * size_of::<[f32; 4]>()
    }

    /// What the adapter holds for a texel of the tile that it works on.
    fn working_bytes(&self, samples: usize) -> u64 {
        (COPIES * texel_bytes(samples) + LafortuneFit::STATE_BYTES + 2 * self.seen_bytes()) as u64
    }

    /// Whether the adapter holds all tiles of the source at once, beside what it works on.
    pub(super) fn keeps(&self, samples: &[usize]) -> bool {
        let texels = self.source.btf().texels();
        let all = texels as u64 * texel_bytes(samples.len()) as u64;
        let working = self.tile_texels(samples.len()).min(texels) as u64 * self.working_bytes(samples.len());
        all + working <= self.memory.adapter
    }

    /// Blocks of which the host holds two: one being read, one being worked on.
    fn blocks(&self, samples: usize) -> Vec<Block> {
        let size @ [width, height] = self.source.btf().size();
        let texels = (self.memory.host / 2 / (samples * 3 * size_of::<f16>())).max(1);
        let [columns, rows] = match self.source.chunk() {
            // Pictures cost as much for a part as for the whole: bands as high as can be.
            None if texels >= width => [width, texels / width],
            None => [texels, 1],
            // Whole chunks, side by side as far as they go.
            Some([columns, rows]) if texels >= columns * rows => [texels / (columns * rows) * columns, rows],
            // Less than a chunk: it is read once for each of its rows.
            Some([columns, _]) if texels >= columns => [columns, texels / columns],
            Some(_) => [texels, 1],
        };
        Block::tiles(size, [columns.min(width), rows.min(height)]).collect()
    }

    /// A tile of `patches`, one after the other, with the given samples, and the places of its texels (column, row).
    pub(super) fn sample(&self, samples: &[usize], patches: &[Block]) -> Result<(Gathered, Vec<[u32; 2]>), PipelineError> {
        let Self { gpu, source, memory, progress, .. } = *self;
        let texels = patches.iter().map(Block::texels).sum();
        let mut halves = vec![f16::ZERO; 3 * samples.len() * texels];
        // The first texel of each patch in the tile.
        let firsts = patches.iter().scan(0, |next, patch| Some(std::mem::replace(next, *next + patch.texels())));
        let patches: Vec<(usize, Block)> = firsts.zip(patches.iter().copied()).collect();
        // Pictures cost as much for a patch as for all: they are read once, so many at a time as the host holds.
        let parts: Vec<(Block, &[(usize, Block)])> = match source.chunk() {
            None => patches
                .iter()
                .map(|(_, patch)| *patch)
                .reduce(|a, b| a.hull(&b))
                .map(|hull| (hull, patches.as_slice()))
                .into_iter()
                .collect(),
            Some(_) => patches.iter().map(|patch| (patch.1, std::slice::from_ref(patch))).collect(),
        };
        progress.expect(parts.iter().map(|(block, _)| block.texels() * samples.len()).sum());
        for (block, patches) in parts {
            let values = 3 * block.texels();
            let at_once = (memory.host / (values * size_of::<f16>())).max(1);
            for (batch, samples) in samples.chunks(at_once).enumerate() {
                let mut read = vec![f16::ZERO; values * samples.len()];
                let stage = progress.stage("read", block.texels(), samples.len());
                source.read(samples, block, &mut read, &|samples| progress.advance(samples * block.texels()))?;
                drop(stage);
                let planes = halves.chunks_exact_mut(texels).skip(3 * batch * at_once).zip(read.chunks_exact(block.texels()));
                for (tile, plane) in planes {
                    for &(first, patch) in patches {
                        for (texel, value) in tile[first..first + patch.texels()].iter_mut().enumerate() {
                            let (column, row) = (patch.column + texel % patch.width, patch.row + texel / patch.width);
                            *value = plane[(row - block.row) * block.width + column - block.column];
                        }
                    }
                }
            }
        }
        let mut words = vec![0_u32; halves.len().div_ceil(2)];
        bytemuck::cast_slice_mut(&mut words)[..halves.len()].copy_from_slice(&halves);
        let gather = Gather::new(gpu)?;
        let gathered = run(gpu, progress, "gather", [texels, samples.len()], |recorder| {
            let halves = gpu.upload("halves", &words)?;
            gather.record(recorder, &halves, samples.len(), texels)
        })?;
        Ok((gathered, patches.iter().flat_map(|(_, patch)| places(*patch, 0..patch.texels())).collect()))
    }

    /// What `work` finds for the texels of each tile of the source, `[texel of the plane][value]` with `width` values a texel. `work` is given a
    /// tile with the given samples and the places of its texels (column, row).
    /// `what` names the result among those kept.
    pub(super) fn for_each_tile<T: Pod>(
        &self, what: &str, width: usize, samples: &[usize], mut work: impl FnMut(Gathered, &[[u32; 2]]) -> Result<Vec<T>, PipelineError>,
    ) -> Result<Vec<T>, PipelineError> {
        let Self { gpu, source, progress, .. } = *self;
        let gather = Gather::new(gpu)?;
        let mut found = Found::<T>::new(source.btf().size(), width);
        found.take_up(what, self.unfinished)?;
        let tile_texels = self.tile_texels(samples.len());
        let left: Vec<(Block, Vec<Range<usize>>)> = self
            .blocks(samples.len())
            .into_iter()
            .map(|block| (block, ranges(block.texels(), tile_texels).filter(|range| !found.has(block, range)).collect::<Vec<_>>()))
            .filter(|(_, ranges)| !ranges.is_empty())
            .collect();
        let units = |texels: usize| texels * samples.len();
        progress.expect(left.iter().map(|(block, _)| 2 * units(block.texels())).sum());

        thread::scope(|scope| {
            // A block waits here until the one before is done with; while it is, the next one is read.
            let (send, receive) = mpsc::sync_channel(0);
            let blocks: Vec<Block> = left.iter().map(|(block, _)| *block).collect();
            scope.spawn(move || {
                for block in blocks {
                    let mut words = vec![0_u32; (samples.len() * 3 * block.texels()).div_ceil(2)];
                    let halves = &mut bytemuck::cast_slice_mut(&mut words)[..samples.len() * 3 * block.texels()];
                    let stage = progress.stage("read", block.texels(), samples.len());
                    let read = source.read(samples, block, halves, &|samples| progress.advance(samples * block.texels()));
                    drop(stage);
                    let failed = read.is_err();
                    // Nobody receives any more if the work has failed.
                    if send.send(read.map(|()| words)).is_err() || failed {
                        return;
                    }
                }
            });
            for (block, ranges) in left {
                let Ok(words) = receive.recv() else { break };
                let words = words?;
                let halves: &[f16] = bytemuck::cast_slice(&words);
                let mut skipped = block.texels();
                for range in ranges {
                    skipped -= range.len();
                    let gathered = run(gpu, progress, "gather", [range.len(), samples.len()], |recorder| {
                        let part = part(&halves[..samples.len() * 3 * block.texels()], block.texels(), range.clone());
                        let halves = gpu.upload("halves", part.as_deref().unwrap_or(&words))?;
                        gather.record(recorder, &halves, samples.len(), range.len())
                    })?;
                    let texels = work(gathered, &places(block, range.clone()))?;
                    if let Some(unfinished) = self.unfinished {
                        unfinished.put(&name(what, block, &range), bytemuck::cast_slice(&texels))?;
                    }
                    found.put(block, &range, &texels);
                    progress.advance(units(range.len()));
                }
                progress.advance(units(skipped));
            }
            Ok(found.values)
        })
    }
}

/// A texel's samples in a tile.
fn texel_bytes(samples: usize) -> usize {
    3 * samples.next_multiple_of(OCTET) * size_of::<f16>()
}

/// `0..texels` in pieces of at most `length`.
fn ranges(texels: usize, length: usize) -> impl Iterator<Item = Range<usize>> {
    (0..texels).step_by(length).map(move |start| start..(start + length).min(texels))
}

/// The values `[plane][texel of the range]` out of `[plane][texel of the block]`, two a word; none if it is all of them.
fn part(halves: &[f16], texels: usize, range: Range<usize>) -> Option<Vec<u32>> {
    if range.len() == texels {
        return None;
    }
    let planes = halves.len() / texels;
    let mut words = vec![0_u32; (planes * range.len()).div_ceil(2)];
    let part: &mut [f16] = bytemuck::cast_slice_mut(&mut words);
    for (part, plane) in part.chunks_exact_mut(range.len()).zip(halves.chunks_exact(texels)) {
        part.copy_from_slice(&plane[range.clone()]);
    }
    Some(words)
}

/// Column and row of texels of a block.
fn places(block: Block, range: Range<usize>) -> Vec<[u32; 2]> {
    range.map(|texel| [count(block.column + texel % block.width), count(block.row + texel / block.width)]).collect()
}

/// The name under which a tile's result is kept.
fn name(what: &str, block: Block, range: &Range<usize>) -> String {
    let Block { column, row, width, height } = block;
    format!("{what} {column} {row} {width} {height} {} {}", range.start, range.end)
}

/// The texels that a name of kept results stands for, if it is one of `what`.
fn named(what: &str, name: &str, size: [usize; 2]) -> Option<(Block, Range<usize>)> {
    let numbers: Vec<usize> = name.strip_prefix(what)?.split_whitespace().map(str::parse).collect::<Result<_, _>>().ok()?;
    let [column, row, width, height, start, end] = numbers.try_into().ok()?;
    let block = Block { column, row, width, height };
    (block.is_within(size) && start < end && end <= block.texels()).then_some((block, start..end))
}

/// Results over the texel plane so far, `[texel][value]`.
struct Found<T> {
    size: [usize; 2],
    /// Values of a texel.
    width: usize,
    values: Vec<T>,
    is_there: Vec<bool>,
}

impl<T: Pod> Found<T> {
    fn new(size: [usize; 2], width: usize) -> Self {
        let texels = size[0] * size[1];
        Self { size, width, values: vec![T::zeroed(); texels * width], is_there: vec![false; texels] }
    }

    /// Takes up what an earlier run has kept of `what`.
    fn take_up(&mut self, what: &str, unfinished: Option<&Unfinished>) -> Result<(), PipelineError> {
        let Some(unfinished) = unfinished else { return Ok(()) };
        for name in unfinished.names()? {
            let Some((block, range)) = named(what, &name, self.size) else { continue };
            let bytes = unfinished.get(&name).filter(|bytes| bytes.len() == range.len() * self.width * size_of::<T>());
            if let Some(bytes) = bytes {
                self.put(block, &range, &bytemuck::allocation::pod_collect_to_vec::<u8, T>(&bytes));
            }
        }
        Ok(())
    }

    fn put(&mut self, block: Block, range: &Range<usize>, values: &[T]) {
        for (index, texel) in range.clone().enumerate() {
            let at = self.at(block, texel);
            self.values[at * self.width..][..self.width].copy_from_slice(&values[index * self.width..][..self.width]);
            self.is_there[at] = true;
        }
    }

    fn has(&self, block: Block, range: &Range<usize>) -> bool {
        range.clone().all(|texel| self.is_there[self.at(block, texel)])
    }

    fn at(&self, block: Block, texel: usize) -> usize {
        (block.row + texel / block.width) * self.size[0] + block.column + texel % block.width
    }
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
