//! BDI, bidirectional images: every value as a half, those of a texel together.

use half::f16;
use rayon::prelude::*;

use super::{
    BtfFileError, Described, Plane, Radiances,
    bytes::{Container, Header},
    header,
    share::Share,
};
use crate::data::{Block, Btf};

/// Bytes of a sample of a texel.
const SAMPLE: usize = 6;

/// Samples that are further apart are read apart: what lies between them would be more than a page of a disk.
const GAP: usize = 4096;

/// Bytes that are held at once.
const HELD: usize = 8 << 20;

/// Bytes of a chunk, as far as a row has them.
const CHUNK: usize = 1 << 20;

/// Samples that one task takes out of what is held.
const GROUP: usize = 32;

/// The header and where the texels are. A texel that the mask leaves out has no measurements, whether the file stores something for it or
/// not: it reads as NaN.
#[derive(Debug)]
pub(super) struct Dump {
    /// Whether texels that are masked out are left out of the file.
    sparse: bool,
    /// Not 0 where a texel was measured, `[row][column]` as stored.
    mask: Vec<u8>,
    /// Texels that are stored before each row.
    before: Vec<u64>,
    /// Index of the first stored texel of each chunk, and where its values start.
    chunks: Vec<(u64, u64)>,
    /// Bytes of a texel's values, half `[view][light][channel]`.
    texel: u64,
}

/// Reads META, BIDIR, size, `u32` rows of a chunk, `u8` compression, the mask, the rotations, and hops over the chunks: `u32` bytes, then as
/// many values. They hold the stored texels in order, x fastest; how many each has follows from its bytes.
pub(super) fn read(header: &mut Header<'_>) -> Result<(Described, Dump), BtfFileError> {
    let (encoding, directions) = (header::meta(header)?, header::directions(header)?);
    let described = Described { encoding, directions, size: header::size(header)? };
    let rows = header.positive("rows of a chunk")?;
    let at = header.offset();
    let compression = header.u8("compression")?;
    if !matches!(compression, 0 | 2) {
        let name = if compression == 1 { " (bzip)" } else { "" };
        return Err(header.unsupported(at, "the compression", "0 (full) and 2 (sparse)", format_args!("{compression}{name}")));
    }
    let [width, height] = described.size.map(u64::from);
    let at = header.pass("mask", &[width, height])?;
    let mut mask = vec![0; header.count(at, "mask", &[width, height])?];
    header.container().read(&mut mask, at)?;
    header::rotations(header)?;

    let columns = header.count(at, "mask", &[width])?;
    let sparse = compression == 2;
    let mut stored = 0;
    let mut before = Vec::new();
    for row in mask.chunks_exact(columns) {
        before.push(stored);
        stored += if sparse { row.iter().filter(|&&texel| texel != 0).count() as u64 } else { width };
    }
    // Each sample is 8 bytes of BIDIR at least, so this is less than the file has.
    let texel = described.samples() * SAMPLE as u64;
    let chunks = chunks(header, stored, texel, [width, height], u64::from(rows))?;
    Ok((described, Dump { sparse, mask, before, chunks, texel }))
}

/// Hops over the chunks. There are no more of them than a full file has.
fn chunks(header: &mut Header<'_>, stored: u64, texel: u64, [width, height]: [u64; 2], rows: u64) -> Result<Vec<(u64, u64)>, BtfFileError> {
    let mut chunks = Vec::new();
    let mut found = 0;
    for _ in 0..height.div_ceil(rows) {
        if found >= stored {
            break;
        }
        let at = header.offset();
        let bytes = u64::from(header.u32("bytes of a chunk")?);
        let texels = bytes / texel;
        if bytes % texel != 0 || texels > width * rows {
            let expected = format!("{texel} for each of at most {width} x {rows} texels");
            return Err(header.unexpected(at, "bytes of a chunk", expected, bytes));
        }
        chunks.push((found, header.pass("a chunk", &[bytes])?));
        found += texels;
    }
    if found < stored {
        return Err(header.unexpected(header.offset(), "number of texels in all chunks", stored, found));
    }
    Ok(chunks)
}

impl Dump {
    /// Columns and rows of blocks that are cheap to read.
    pub(super) fn chunk(&self, width: usize) -> [usize; 2] {
        [usize::try_from(CHUNK as u64 / self.texel).unwrap_or(1).clamp(1, width), 1]
    }

    /// Where a texel's values start, if it was measured.
    fn offset(&self, width: usize, texel: usize) -> Option<u64> {
        if self.mask[texel] == 0 {
            return None;
        }
        let (row, column) = (texel / width, texel % width);
        let left = &self.mask[row * width..texel];
        let inside = if self.sparse { left.iter().filter(|&&texel| texel != 0).count() } else { column };
        let index = self.before[row] + inside as u64;
        let (first, start) = self.chunks[self.chunks.partition_point(|&(first, _)| first <= index) - 1];
        Some(start + (index - first) * self.texel)
    }

    /// Reads radiance as [`Source::read`](crate::io::Source::read) does.
    pub(super) fn read(
        &self, container: &Container, btf: &Btf, samples: &[usize], block: Block, radiance: &mut [f16], done: &(dyn Fn(usize) + Sync),
    ) -> Result<(), BtfFileError> {
        let (width, texels, plane) = (btf.size()[0], block.texels(), Plane::of(btf));
        // Runs of samples that are read at once, and where each sample is in what is read of a texel.
        let mut runs: Vec<(u64, usize)> = Vec::new();
        let mut places = Vec::with_capacity(samples.len());
        let mut span = 0;
        for (&sample, before) in samples.iter().zip([None].into_iter().chain(samples.iter().map(Some))) {
            let gap = before.map(|&before| (sample - before - 1) * SAMPLE).filter(|&gap| gap < GAP);
            let more = gap.unwrap_or(0) + SAMPLE;
            match runs.last_mut().filter(|_| gap.is_some()) {
                Some((_, bytes)) => *bytes += more,
                None => runs.push(((sample * SAMPLE) as u64, SAMPLE)),
            }
            span += more;
            places.push(span - SAMPLE);
        }
        let strip = (HELD / span).clamp(1, texels);
        let mut held = vec![0; strip * span];
        let mut share = Share::new(samples.len(), texels.div_ceil(strip), done);
        for start in (0..texels).step_by(strip) {
            let range = start..(start + strip).min(texels);
            let offsets: Vec<Option<u64>> = plane
                .runs(block, range.clone())
                .flat_map(|run| run.texel..run.texel + run.texels)
                .map(|texel| self.offset(width, texel))
                .collect();
            held.par_chunks_exact_mut(span).zip(&offsets).try_for_each(|(values, offset)| {
                let Some(offset) = offset else { return Ok(()) };
                let mut rest = values;
                for &(first, bytes) in &runs {
                    let (part, after) = rest.split_at_mut(bytes);
                    container.read(part, offset + first)?;
                    rest = after;
                }
                Ok(())
            })?;
            radiance.par_chunks_mut(GROUP * 3 * texels).zip(samples.par_chunks(GROUP).zip(places.par_chunks(GROUP))).for_each(
                |(radiance, (samples, places))| {
                    let radiances: Vec<Radiances> = samples.iter().map(|&sample| Radiances::of(btf, sample)).collect();
                    for ((at, values), offset) in range.clone().zip(held.chunks_exact(span)).zip(&offsets) {
                        for (index, (&place, radiances)) in places.iter().zip(&radiances).enumerate() {
                            for channel in 0..3 {
                                let bytes = [values[place + 2 * channel], values[place + 2 * channel + 1]];
                                let value = if offset.is_some() { radiances.of_measured(f16::from_le_bytes(bytes)) } else { f16::NAN };
                                radiance[(3 * index + channel) * texels + at] = value;
                            }
                        }
                    }
                },
            );
            share.step();
        }
        Ok(())
    }
}
