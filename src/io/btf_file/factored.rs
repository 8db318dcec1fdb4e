//! What the factorised kinds have in common: a stored value is the dot product of a row of sample factors, kept in memory, and a row of
//! texel factors, read for each block.
//!
//! Sums are in f32, in the order of the components. Their error is at most n 2⁻²⁴ Σ|u_k v_k| with n components, for the some hundred of a
//! published file 6e-6 of that sum: a hundredth of a half's last place unless terms cancel.

use std::ops::Range;

use half::{f16, slice::HalfFloatSliceExt};
use rayon::prelude::*;

use super::{BtfFileError, Plane, Radiances, bytes::Container, color::Color, scalar::Table, share::Share};
use crate::data::{Block, Btf};

/// Texel factors that are held at once: 256 KiB of them stay in a core's cache while all samples pass.
const HELD: usize = 1 << 16;

/// Bytes of a chunk's texel factors.
const CHUNK: usize = 1 << 20;

/// Where the channels of a product are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Channels {
    /// Sample factors are `[sample][channel][component]`, texel factors `[texel][component]`.
    OfSamples,
    /// Sample factors are `[sample][component]`, texel factors `[texel][channel][component]`.
    OfTexels,
    /// The product is of one channel.
    One,
}

/// What is added to each dot product, as one more component.
#[derive(Debug, Clone, Copy)]
pub(super) enum Mean {
    /// Nothing.
    None,
    /// It is the last of the sample factors: the last of the texel factors is 1.
    OfSamples,
    /// It is a table of the texel factors' rows: the last of the sample factors is 1.
    OfTexels(Table),
}

/// A matrix of stored values as a product of two.
#[derive(Debug)]
pub(super) struct Product {
    /// Components, that of the mean included.
    pub(super) components: usize,
    /// Sample factors.
    pub(super) samples: Vec<f32>,
    /// Texel factors, without that of the mean.
    pub(super) texels: Table,
    pub(super) mean: Mean,
    pub(super) channels: Channels,
}

impl Product {
    /// Rows of texel factors that a texel has.
    fn planes(&self) -> usize {
        if self.channels == Channels::OfTexels { 3 } else { 1 }
    }

    /// Texel factors of `range` of the block's texels, `[plane][component][texel]`.
    fn load(&self, container: &Container, plane: Plane, block: Block, range: Range<usize>) -> Result<Vec<f32>, BtfFileError> {
        let (texels, planes, stored) = (range.len(), self.planes(), self.texels.columns());
        let mut factors = vec![1.0; planes * self.components * texels];
        for run in plane.runs(block, range) {
            let mut put = |row: usize, first: usize, values: &[f32]| {
                let at = (row % planes * self.components + first) * texels + run.at + row / planes;
                factors[at..].iter_mut().step_by(texels).zip(values).for_each(|(factor, value)| *factor = *value);
            };
            let (first, rows) = (run.texel * planes, run.texels * planes);
            self.texels.read(container, first, rows, |row, values| put(row, 0, values))?;
            if let Mean::OfTexels(means) = self.mean {
                means.read(container, first, rows, |row, values| put(row, stored, values))?;
            }
        }
        Ok(factors)
    }

    /// One channel of one sample under loaded texel factors.
    fn evaluate(&self, factors: &[f32], sample: usize, channel: usize, values: &mut [f32]) {
        let (row, plane) = match self.channels {
            Channels::OfSamples => (3 * sample + channel, 0),
            Channels::OfTexels => (sample, channel),
            Channels::One => (sample, 0),
        };
        let (n, texels) = (self.components, values.len());
        dot(&self.samples[row * n..][..n], &factors[plane * n * texels..][..n * texels], values);
    }
}

/// `values[texel]` = Σ `sample[component]` · `texels[component][texel]`.
fn dot(sample: &[f32], texels: &[f32], values: &mut [f32]) {
    let count = values.len();
    values.fill(0.0);
    let (fours, rest) = sample.as_chunks::<4>();
    for (&[a, b, c, d], rows) in fours.iter().zip(texels.chunks_exact(4 * count)) {
        let (first, second) = rows.split_at(2 * count);
        let ((va, vb), (vc, vd)) = (first.split_at(count), second.split_at(count));
        for ((((value, va), vb), vc), vd) in values.iter_mut().zip(va).zip(vb).zip(vc).zip(vd) {
            *value = *value + a * va + b * vb + c * vc + d * vd;
        }
    }
    for (&a, row) in rest.iter().zip(texels[4 * fours.len() * count..].chunks_exact(count)) {
        values.iter_mut().zip(row).for_each(|(value, v)| *value += a * v);
    }
}

/// Samples that share their products: all of a file, or those of a view.
#[derive(Debug)]
pub(super) struct Set {
    /// One for all channels, or one a channel.
    pub(super) products: Vec<Product>,
}

impl Set {
    /// All channels of one of its samples under loaded texel factors of each product, `[channel][texel]`.
    fn evaluate(&self, factors: &[Vec<f32>], sample: usize, values: &mut [f32]) {
        let texels = values.len() / 3;
        for (channel, values) in values.chunks_exact_mut(texels).enumerate() {
            let product = channel % self.products.len();
            self.products[product].evaluate(&factors[product], sample, channel, values);
        }
    }
}

/// A factorised container.
#[derive(Debug)]
pub(super) struct Factored {
    pub(super) sets: Vec<Set>,
    /// From stored values to RGB.
    pub(super) color: Color,
}

impl Factored {
    /// Columns and rows of blocks that are cheap to read.
    pub(super) fn chunk(&self, width: usize) -> [usize; 2] {
        let texel =
            self.sets.iter().flat_map(|set| &set.products).map(|product| product.planes() * product.texels.row_bytes()).sum::<usize>();
        [(CHUNK / texel).clamp(1, width), 1]
    }

    /// Reads radiance as [`Source::read`](crate::io::Source::read) does.
    pub(super) fn read(
        &self, container: &Container, btf: &Btf, samples: &[usize], block: Block, radiance: &mut [f16], done: &(dyn Fn(usize) + Sync),
    ) -> Result<(), BtfFileError> {
        let texels = block.texels();
        let of_set = btf.pairs().len() / self.sets.len();
        let mut rest = radiance;
        for group in samples.chunk_by(|a, b| a / of_set == b / of_set) {
            let set = &self.sets[group[0] / of_set];
            let (part, after) = rest.split_at_mut(3 * texels * group.len());
            rest = after;
            let held: usize = set.products.iter().map(|product| product.planes() * product.components).sum();
            let strip = (HELD / held).clamp(1, texels);
            let mut share = Share::new(group.len(), texels.div_ceil(strip), done);
            for start in (0..texels).step_by(strip) {
                let range = start..(start + strip).min(texels);
                let load = |product: &Product| product.load(container, Plane::of(btf), block, range.clone());
                let factors = set.products.par_iter().map(load).collect::<Result<Vec<_>, _>>()?;
                part.par_chunks_exact_mut(3 * texels).zip(group).for_each_init(
                    || vec![0.0; 3 * range.len()],
                    |values, (radiance, &sample)| {
                        set.evaluate(&factors, sample % of_set, values);
                        self.color.to_rgb(values);
                        let radiances = Radiances::of(btf, sample);
                        for (channel, values) in values.chunks_exact_mut(range.len()).enumerate() {
                            values.iter_mut().for_each(|value| *value = radiances.of_reconstructed(*value));
                            radiance[channel * texels..][range.clone()].convert_from_f32_slice(values);
                        }
                    },
                );
                share.step();
            }
        }
        Ok(())
    }
}
