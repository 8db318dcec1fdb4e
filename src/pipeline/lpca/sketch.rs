//! The mean of all texels and a sketch of them, from which the global basis comes (randomised SVD: Halko, Martinsson, Tropp 2011).
//!
//! The sketch of Clarkson and Woodruff (2013): each texel is added, with a random sign, to one of as many sums as the sketch has vectors. It costs an
//! addition a value. Its span holds the leading eigenvectors nearly as well as that of a dense random matrix: what 64 vectors leave of the path-traced
//! weave and blocks is 0.0717 and 0.1034 of the radiance, relative RMS, for 0.0734 and 0.1017 with a Gaussian one.

use nalgebra::DMatrix;

use super::{Space, Stages, Tiles, kept};
use crate::{
    data::OCTET,
    model::LpcaSettings,
    pipeline::{PipelineError, tiles::run},
    stage::{Lifted, Line, Members, count},
};

/// Sums more than the basis has vectors.
const OVERSAMPLING: usize = 16;

/// Ranks that are chosen are multiples of this, as the adapter fills them up to.
const STEP: usize = 16;

/// Eigenvalues below this part of the largest are rounding of the sums.
const NOISE: f64 = 1e-10;

/// A sketch of all texels.
pub struct Sketch {
    /// Mean of each value over the texels that have it.
    pub mean: Vec<f64>,
    /// Sums of texels about the mean, with signs.
    sums: Vec<Vec<f64>>,
}

/// Sketches the texels in one pass.
pub fn sketch(tiles: &mut Tiles<'_>, stages: &Stages, settings: &LpcaSettings) -> Result<Sketch, PipelineError> {
    let texels = tiles.texels();
    let wanted = settings.rank.unwrap_or(settings.auto_rank()) as usize + OVERSAMPLING;
    let buckets = wanted.min(texels);
    let lines = 3 * tiles.samples().div_ceil(OCTET);
    let values = lines * OCTET;
    let mut random = fastrand::Rng::with_seed(u64::from(settings.seed));
    // As many sums as texels: each is one.
    let bucket_of: Vec<u32> =
        (0..texels).map(|texel| if buckets == texels { count(texel) } else { random.u32(0..count(buckets)) }).collect();
    let signs: Vec<f32> = (0..texels).map(|_| if random.bool() { 1.0 } else { -1.0 }).collect();

    // [bucket][Σ x, Σ ±x, number][value]
    let (gpu, progress) = (tiles.job().gpu, tiles.job().progress);
    let found = kept(tiles, "lpca sketch", |tiles| {
        let zero = gpu.upload("centre", &vec![Line::default(); lines])?;
        let lifted = Lifted::new(gpu, buckets, 1, lines)?;
        tiles.for_each(|gathered, texels| {
            let own: Vec<u32> = texels.iter().map(|&texel| bucket_of[texel]).collect();
            let members = Members::new(&own, buckets);
            let weights: Vec<[f32; 4]> = members.texels.iter().map(|&member| [1.0, signs[texels[member as usize]], 0.0, 0.0]).collect();
            let size = [texels.len(), gathered.tile.samples];
            run(gpu, progress, "lpca_sketch", size, |recorder| {
                let weights = gpu.upload("signs", &weights)?;
                stages.lift.record(recorder, &gathered.tile, &zero, &members.upload(gpu)?, &weights, &lifted)
            })
        })?;
        let (sums, counts) = (lifted.sums(gpu)?.concat(), lifted.counts(gpu)?);
        let of_bucket = |bucket: usize| {
            let sum = |weight: usize| &sums[(bucket * 4 + weight) * lines..][..lines];
            [sum(0), sum(1), &counts[bucket * lines..][..lines]].concat()
        };
        Ok((0..buckets).flat_map(of_bucket).flat_map(|line| line.values()).collect())
    })?;

    let rows: Vec<&[f32]> = found.chunks_exact(values).collect();
    let total = |row: usize, value: usize| rows.iter().skip(row).step_by(3).map(|sums| f64::from(sums[value])).sum::<f64>();
    let mean: Vec<f64> = (0..values).map(|value| total(0, value) / total(2, value).max(1.0)).collect();
    let sign_sums = bucket_of.iter().zip(&signs).fold(vec![0.0; buckets], |mut sums, (&bucket, &sign)| {
        sums[bucket as usize] += f64::from(sign);
        sums
    });
    let about_mean =
        |bucket: usize| rows[3 * bucket + 1].iter().zip(&mean).map(|(&sum, mean)| f64::from(sum) - sign_sums[bucket] * mean).collect();
    Ok(Sketch { sums: (0..buckets).map(about_mean).collect(), mean })
}

/// Orthonormal vectors of the space that hold most of the sketch: as many as asked for, or as leave out little.
pub fn basis(space: &Space, sketch: &Sketch, settings: &LpcaSettings) -> Vec<Vec<f64>> {
    let vectors: Vec<Vec<f64>> = sketch.sums.iter().map(|sum| sum.iter().zip(&space.scale).map(|(value, s)| value * s).collect()).collect();
    let most = settings.rank.unwrap_or(settings.auto_rank()) as usize;
    let is_enough = |left: f64, rank: usize| {
        let all = vectors.len();
        // What the sketch itself left out is spread evenly over its sums; this much more lies in the vectors that are left.
        #[expect(clippy::cast_precision_loss, reason = "numbers of vectors")]
        let left = if rank < all { left * all as f64 / (all - rank) as f64 } else { 0.0 };
        settings.rank.is_none() && rank.is_multiple_of(STEP) && left <= LpcaSettings::LEFT_OUT
    };
    orthonormal(&vectors, most, is_enough)
}

/// Orthonormal vectors with the span of those given, leading directions first: at most `most`, fewer where the rest is rounding, or where
/// `is_enough` says so, given the part of the energy that is left and how many there are.
pub fn orthonormal(vectors: &[Vec<f64>], most: usize, is_enough: impl Fn(f64, usize) -> bool) -> Vec<Vec<f64>> {
    let Some(first) = vectors.first() else { return Vec::new() };
    let matrix = DMatrix::from_iterator(first.len(), vectors.len(), vectors.iter().flatten().copied());
    let eigen = matrix.tr_mul(&matrix).symmetric_eigen();
    let mut order: Vec<usize> = (0..vectors.len()).collect();
    order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
    let total: f64 = eigen.eigenvalues.iter().map(|value| value.max(0.0)).sum();
    let least = NOISE * order.first().map_or(0.0, |&index| eigen.eigenvalues[index]);
    let mut left = total;
    let mut rank = 0;
    for &index in order.iter().take(most) {
        let value = eigen.eigenvalues[index];
        if value <= least || value <= 0.0 || (rank > 0 && is_enough(left / total, rank)) {
            break;
        }
        left -= value;
        rank += 1;
    }
    let combination = DMatrix::from_fn(vectors.len(), rank, |row, column| {
        let index = order[column];
        eigen.eigenvectors[(row, index)] / eigen.eigenvalues[index].sqrt()
    });
    (matrix * combination).column_iter().map(|column| column.iter().copied().collect()).collect()
}
