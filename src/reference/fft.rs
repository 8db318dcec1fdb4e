//! Twin of `fft`: each axis by the definition of the discrete Fourier transform, in f64.

use std::f64::consts::TAU;

use crate::{data::Map, model::Fourier};

/// The transform of a complex field of (real, imaginary): every frequency as its own sum over the whole axis, rows first.
#[must_use]
#[expect(clippy::cast_precision_loss, reason = "far fewer values than 2^53")]
pub fn fft(field: &Map<[f64; 2]>, fourier: Fourier) -> Map<[f64; 2]> {
    let (width, height) = (field.width(), field.height());
    let (row_waves, column_waves) = (waves(width, fourier), waves(height, fourier));
    let rows = Map::from_fn(width, height, |k, row| {
        (0..width).fold([0.0; 2], |sum, j| multiply_add(sum, field[(j, row)], row_waves[j * k % width]))
    });
    let both = Map::from_fn(width, height, |column, k| {
        (0..height).fold([0.0; 2], |sum, j| multiply_add(sum, rows[(column, j)], column_waves[j * k % height]))
    });
    let scale = if fourier == Fourier::Inverse { 1.0 / (width * height) as f64 } else { 1.0 };
    both.map(|value| value.map(|part| scale * part))
}

/// exp(−2πi k/length) for all k, the conjugate for the inverse.
#[expect(clippy::cast_precision_loss, reason = "far fewer values than 2^53")]
fn waves(length: usize, fourier: Fourier) -> Vec<[f64; 2]> {
    let turn = if fourier == Fourier::Forward { -TAU } else { TAU };
    let wave = |k: usize| (turn * k as f64 / length as f64).sin_cos();
    (0..length).map(wave).map(|(sin, cos)| [cos, sin]).collect()
}

fn multiply_add(sum: [f64; 2], x: [f64; 2], w: [f64; 2]) -> [f64; 2] {
    [sum[0] + x[0] * w[0] - x[1] * w[1], sum[1] + x[0] * w[1] + x[1] * w[0]]
}
