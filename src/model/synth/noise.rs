//! Value noise that closes at the edges of a lattice, in f64 (the noise of `kernels/common/noise.wgsl`).

use super::SynthPlace;
use crate::model::pattern::hash;

/// Uniform in [0, 1) for a cell of a lattice; other `layer`s are other numbers.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "cells of a lattice are whole numbers of 0 or more")]
pub(super) fn random(cell: [f64; 2], count: [f64; 2], seed: u32, layer: u32) -> f64 {
    let [x, y] = [0, 1].map(|axis| cell[axis].rem_euclid(count[axis]) as u32);
    f64::from(hash(x ^ hash(y ^ hash(seed ^ hash(layer)))) >> 8) / f64::from(1 << 24)
}

/// Smooth noise in [0, 1), about `per_edge` lattice points along the shorter edge, joined by 3t² − 2t³ (Perlin 1985).
pub(super) fn noise(place: SynthPlace, per_edge: f64, seed: u32, layer: u32) -> f64 {
    let (at, count) = place.cells(per_edge, 1.0);
    let corner = at.map(f64::floor);
    let weight = [0, 1].map(|axis| smooth(at[axis] - corner[axis]));
    let value = |dx: f64, dy: f64| random([corner[0] + dx, corner[1] + dy], count, seed, layer);
    let row = |dy: f64| value(0.0, dy) + (value(1.0, dy) - value(0.0, dy)) * weight[0];
    row(0.0) + (row(1.0) - row(0.0)) * weight[1]
}

/// Noise of five octaves in [0, 1), each half as high as the one before.
pub(super) fn fractal(place: SynthPlace, per_edge: f64, seed: u32, layer: u32) -> f64 {
    let octaves = (0..5).map(|octave: u32| {
        let scale = f64::from(1_u32 << octave);
        (noise(place, per_edge * scale, seed, layer + 16 * octave) / scale, 1.0 / scale)
    });
    let (sum, weights) = octaves.fold((0.0, 0.0), |(sum, weights), (value, weight)| (sum + value, weights + weight));
    sum / weights
}

/// 0 below 0, 1 above 1, 3t² − 2t³ between.
pub(super) fn smooth(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
