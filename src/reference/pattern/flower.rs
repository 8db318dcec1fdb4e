//! Flower: outlines by differences instead of derivatives.

use std::f64::consts::TAU;

use super::marks::{Marks, faded, grain, unit};
use crate::model::pattern::hash;

/// Uniform in [low, high), another one for each `index`.
fn draw(low: f64, high: f64, seed: u32, index: u32) -> f64 {
    low + (high - low) * unit(hash(seed ^ hash(index)))
}

/// A leaf or petal that points in the direction `angle`.
struct Blade {
    angle: f64,
    length: f64,
    half: f64,
    pointed: bool,
}

impl Blade {
    /// Lengths along and across it.
    fn frame(&self, place: [f64; 2]) -> [f64; 2] {
        let (radius, angle) = (place[0].hypot(place[1]), place[1].atan2(place[0]) - self.angle);
        [radius * angle.cos(), radius * angle.sin()]
    }

    /// Its squared half-width, less the square of the distance from its axis.
    fn inside(&self, [x, v]: [f64; 2]) -> f64 {
        let u = if self.pointed { 1.0 - x / self.length } else { x / self.length };
        let shape = if u < 0.0 { -u * u } else { 6.75 * (u * u - u * u * u) };
        self.half * self.half * shape - v * v
    }

    /// Distance from the outline, to first order.
    fn depth(&self, [x, v]: [f64; 2]) -> f64 {
        let h = 1e-6;
        let across = self.inside([x, v + h]) - self.inside([x, v - h]);
        let along = self.inside([x + h, v]) - self.inside([x - h, v]);
        self.inside([x, v]) / (along.hypot(across) / (2.0 * h)).max(1e-4)
    }
}

impl Marks {
    fn over(self, below: f64, paint: f64, depth: f64) -> f64 {
        let closed = self.edge(0.0, 0.006, depth);
        closed * paint + (1.0 - closed) * below * (1.0 - 0.75 * self.edge(-0.012, 0.0, depth))
    }

    fn leaf(self, place: [f64; 2], angle: f64, below: f64, seed: u32) -> f64 {
        let blade = Blade { angle, length: 0.48, half: 0.085, pointed: true };
        let [x, v] = blade.frame(place);
        let depth = blade.depth([x, v]) + 0.006 * (grain(place, [30.0; 2], seed, self.texel) - 0.5);
        let side = 9.0 * (x / 0.48 - 0.25 * v.abs() / 0.085);
        let from_side = (side - (side + 0.5).floor()) * 0.48 / 9.0;
        let furrow = self.ridge(v, 0.006).max(0.6 * self.ridge(from_side, 0.005));
        let streaks = grain(place, [25.0; 2], seed.wrapping_add(1), self.texel);
        let paint = (0.5 + 0.2 * streaks + 0.25 * self.ridge(depth - 0.008, 0.007)) * (1.0 - 0.6 * furrow);
        self.over(below, paint, depth)
    }

    fn petal(self, place: [f64; 2], blade: &Blade, below: f64, seed: u32) -> f64 {
        let [x, v] = blade.frame(place);
        let depth = blade.depth([x, v]) + 0.012 * (grain(place, [16.0; 2], seed, self.texel) - 0.5);
        let along = x / blade.length;
        let fan = v / blade.half / along.max(0.1);
        let texel_fan = self.texel / (blade.half * along.max(0.1));
        let streaks = grain([along, fan], [2.5, 9.0], seed.wrapping_add(1), texel_fan);
        let from_vein = (2.0 * fan - (2.0 * fan + 0.5).floor()) * 0.5 * blade.half;
        let vein = self.ridge(from_vein, 0.006) * (1.0 - self.edge(0.5, 0.95, along));
        let rim = 0.75 * self.ridge(depth - 0.012, 0.010);
        let body = 0.3 + 0.35 * streaks + 0.2 * (1.0 - along) + 0.2 * vein;
        self.over(below, (rim + (1.0 - rim) * body).clamp(0.0, 1.0), depth)
    }

    fn centre(self, place: [f64; 2], below: f64, seed: u32) -> f64 {
        let spacing = 0.0165;
        let radius = place[0].hypot(place[1]);
        let depth = 0.075 - radius + 0.008 * (grain(place, [40.0; 2], seed, self.texel) - 0.5);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small whole number")]
        let ring = (radius / spacing).round() as u32;
        let start = draw(0.0, 1.0, seed, ring);
        // The nearest of all the ring's dots.
        let dots = (6 * ring).max(1);
        let from_dot = (0..dots)
            .map(|dot| {
                let (y, x) = (TAU * (f64::from(dot) / f64::from(dots) + start)).sin_cos();
                let out = f64::from(ring) * spacing;
                (place[0] - out * x).hypot(place[1] - out * y)
            })
            .fold(f64::INFINITY, f64::min);
        let dab = faded(0.35, 1.0 - self.edge(0.15 * spacing, 0.5 * spacing, from_dot), self.texel / spacing);
        self.over(below, 0.45 + 0.55 * dab, depth)
    }

    pub(super) fn flower(self, place: [f64; 2], petals: u32) -> f64 {
        let turn = TAU / f64::from(petals);
        let start = draw(0.0, TAU, self.seed, 0);
        let mut thickness = 0.0;
        for (index, gap) in [0, petals.div_ceil(2)].into_iter().enumerate() {
            #[expect(clippy::cast_possible_truncation, reason = "0 or 1")]
            let index = index as u32;
            let angle = start + (f64::from(gap) + 0.5 + draw(-0.15, 0.15, self.seed, 1 + index)) * turn;
            thickness = self.leaf(place, angle, thickness, self.seed.wrapping_add(16 * index));
        }
        for index in 0..petals {
            let own = hash(self.seed ^ hash(100 + index));
            let angle = start + (f64::from(index) + draw(-0.12, 0.12, own, 0)) * turn;
            let length = draw(0.36, 0.41, own, 1);
            let half = (draw(1.15, 1.4, own, 2) * 0.66 * length * (0.5 * turn).min(0.7).tan()).min(0.15);
            thickness = self.petal(place, &Blade { angle, length, half, pointed: false }, thickness, own);
        }
        self.centre(place, thickness, self.seed.wrapping_add(40))
    }
}
