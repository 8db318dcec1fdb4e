//! Edges, ridges and grain, as in the kernel `pattern_marks`.

use crate::model::pattern::hash;

/// A pattern's seed, and the width of a texel in pattern coordinates.
#[derive(Debug, Clone, Copy)]
pub(super) struct Marks {
    pub(super) seed: u32,
    pub(super) texel: f64,
}

impl Marks {
    /// From 0 to 1 about the middle of `low` and `high`.
    pub(super) fn edge(self, low: f64, high: f64, value: f64) -> f64 {
        edge(low, high, value, self.texel)
    }

    pub(super) fn ridge(self, distance: f64, width: f64) -> f64 {
        let least = width.max(self.texel);
        (-(distance / least).powi(2)).exp() * width / least
    }

    pub(super) fn grain(self, place: [f64; 2], cells: [f64; 2], index: u32) -> f64 {
        grain(place, cells, self.seed.wrapping_add(index), self.texel)
    }
}

pub(super) fn edge(low: f64, high: f64, value: f64, texel: f64) -> f64 {
    let middle = 0.5 * (low + high);
    let half = 0.5 * (high - low).max(1.5 * texel);
    smoothstep(middle - half, middle + half, value)
}

pub(super) fn faded(mean: f64, value: f64, texel_cells: f64) -> f64 {
    let kept = (2.0 * (1.0 - texel_cells)).clamp(0.0, 1.0);
    mean + kept * (value - mean)
}

pub(super) fn grain(place: [f64; 2], cells: [f64; 2], seed: u32, texel: f64) -> f64 {
    let at = [place[0] * cells[0], place[1] * cells[1]];
    faded(0.5, tiled_noise(at, [65536; 2], seed), texel * cells[0].max(cells[1]))
}

/// The upper 24 of 32 random bits, in [0, 1).
pub(super) fn unit(bits: u32) -> f64 {
    f64::from(bits >> 8) / 16_777_216.0
}

/// Random bits of a lattice point whose coordinates are whole numbers.
pub(super) fn lattice_bits(point: [f64; 2], period: [u32; 2], seed: u32) -> u32 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an integer in 0..period")]
    let [x, y] = [0, 1].map(|axis| point[axis].rem_euclid(f64::from(period[axis])) as u32);
    hash(x ^ hash(y ^ hash(seed)))
}

/// Lattice values weighted by the four corners' cubic shares.
pub(super) fn tiled_noise(place: [f64; 2], period: [u32; 2], seed: u32) -> f64 {
    let mut sum = 0.0;
    for corner in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]] {
        let point = [0, 1].map(|axis| place[axis].floor() + corner[axis]);
        let share = [0, 1].map(|axis| 1.0 - smoothstep(0.0, 1.0, (place[axis] - point[axis]).abs()));
        sum += share[0] * share[1] * unit(lattice_bits(point, period, seed));
    }
    sum
}

pub(super) fn smoothstep(low: f64, high: f64, value: f64) -> f64 {
    let t = ((value - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
