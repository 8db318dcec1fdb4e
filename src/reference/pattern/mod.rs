//! Twin of `pattern`: places by whole numbers, repetitions by trying all, shapes without bins, in f64.

mod flower;
mod marks;
mod spatter;
mod stroke;

use marks::{Marks, tiled_noise};

use crate::{
    data::Map,
    model::{self, Placement},
};

/// Thickness that `pattern` draws at `placement` on a plane of `width` x `height` texels that repeats.
///
/// # Panics
/// If the pattern is an image: [`pattern_image`](super::pattern_image()) draws those.
#[must_use]
pub fn pattern(pattern: model::Pattern, placement: Placement, width: u32, height: u32) -> Map<f64> {
    let plane = Plane { size: [width, height], placement };
    let shapes = pattern.shapes();
    let marks = Marks { seed: pattern.seed(), texel: plane.texel() };
    Map::from_fn(width as usize, height as usize, |column, row| {
        let place = plane.place(column, row);
        match pattern {
            model::Pattern::Uniform { drawn } => drawn,
            model::Pattern::Splash { .. } => plane.thickest(place, |own| marks.splash(own, &shapes)),
            model::Pattern::Flower { petals, .. } => plane.thickest(place, |own| marks.flower(own, petals)),
            model::Pattern::Brush { width, .. } => plane.thickest(place, |own| marks.brush(own, width)),
            model::Pattern::Spatter { cover, .. } => spatter::spatter(&plane, marks, place, cover),
            model::Pattern::Stripes { count, width } => plane.stripes(place, count, width),
            model::Pattern::Noise { count, .. } => plane.clouds(place, marks, count),
            model::Pattern::Image { .. } => panic!("images have a twin of their own"),
        }
    })
}

/// A plane of cells.
pub(super) struct Plane {
    pub(super) size: [u32; 2],
    pub(super) placement: Placement,
}

impl Plane {
    pub(super) fn edges(&self) -> [f64; 2] {
        self.placement.edges(self.size)
    }

    /// A texel's centre in cell coordinates, from the middle of the pattern. Along an axis of n texels and c cells the centre of texel k
    /// lies ((2k + 1) c mod 2n)/2n of a cell from its lower edge.
    pub(super) fn place(&self, column: usize, row: usize) -> [f64; 2] {
        let edges = self.edges();
        let texel = [column as u64, u64::from(self.size[1]) - 1 - row as u64];
        [0, 1].map(|axis| {
            let [twice, cells] = [2 * u64::from(self.size[axis]), u64::from(self.placement.tiling[axis])];
            let part = ((2 * texel[axis] + 1) * cells) % twice;
            #[expect(clippy::cast_precision_loss, reason = "far below 2^53")]
            let in_cell = (part as f64 / twice as f64 - 0.5) * edges[axis];
            in_cell - self.placement.offset[axis]
        })
    }

    /// Width of a texel in pattern coordinates.
    fn texel(&self) -> f64 {
        let [width, height] = self.placement.cell(self.size);
        (1.0 / (width.min(height) * self.placement.size)).min(0.25)
    }

    /// The thickest of all repetitions of `mark`, which is drawn in pattern coordinates.
    fn thickest(&self, place: [f64; 2], mark: impl Fn([f64; 2]) -> f64) -> f64 {
        let edges = self.edges();
        let nearest = [0, 1].map(|axis| (place[axis] + 0.5 * edges[axis]).rem_euclid(edges[axis]) - 0.5 * edges[axis]);
        let reach = 0.49 + 0.75 * self.texel();
        let mut thickest = 0.0_f64;
        for repetition in 0..81 {
            let [i, j] = [repetition % 9 - 4, repetition / 9 - 4].map(f64::from);
            let apart = [nearest[0] - i * edges[0], nearest[1] - j * edges[1]];
            let radius = apart[0].hypot(apart[1]) / self.placement.size;
            let angle = apart[1].atan2(apart[0]) - self.placement.rotation;
            if radius <= reach {
                thickest = thickest.max(mark([radius * angle.cos(), radius * angle.sin()]));
            }
        }
        thickest
    }

    fn stripes(&self, place: [f64; 2], count: u32, painted: f64) -> f64 {
        let edges = self.edges();
        let wave = self.placement.wave(count, self.size);
        let periods = [0, 1].map(|axis| wave[axis] / edges[axis]);
        let phase = periods[0] * place[0] + periods[1] * place[1];
        let [width, height] = self.placement.cell(self.size);
        let texel_periods = periods[0].hypot(periods[1]) / width.min(height);
        let reach = texel_periods.clamp(0.06, 1.0);
        // The share of the parabola over the painted intervals.
        let antiderivative = |x: f64| 0.75 * (x - x * x * x / (3.0 * reach * reach)) / reach;
        let mut sum = 0.0;
        for stripe in -3..=3 {
            let middle = phase.floor() + f64::from(stripe) - phase;
            let [low, high] = [middle - 0.5 * painted, middle + 0.5 * painted].map(|end| end.clamp(-reach, reach));
            sum += antiderivative(high) - antiderivative(low);
        }
        let lost = (texel_periods - 1.0).clamp(0.0, 1.0);
        sum * (1.0 - lost) + painted * lost
    }

    fn clouds(&self, place: [f64; 2], marks: Marks, count: u32) -> f64 {
        let edges = self.edges();
        let lattice = self.placement.lattice(2 * count, self.size);
        let (mut sum, mut whole) = (0.0, 0.0);
        for octave in 0..6 {
            let period = lattice.map(|points| points << octave);
            let cells = [0, 1].map(|axis| f64::from(period[axis]) * self.placement.size / edges[axis]);
            let at = [0, 1].map(|axis| (place[axis] / edges[axis] + 0.5) * f64::from(period[axis]));
            let value = tiled_noise(at, period, marks.seed.wrapping_add(octave));
            sum += marks::faded(0.5, value, marks.texel * cells[0].max(cells[1])) * 0.5_f64.powi(octave.cast_signed());
            whole += 0.5_f64.powi(octave.cast_signed());
        }
        marks::smoothstep(0.2, 0.8, sum / whole)
    }
}
