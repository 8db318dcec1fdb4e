//! Twin of `pattern`: nearest repetitions by trying all nine, noise as a sum over corners, in f64.

use crate::{
    data::Map,
    model::{self, Capsule, pattern::hash},
};

/// Drawn thickness of a plane of `width` x `height` texels that repeats.
#[must_use]
pub fn pattern(pattern: model::Pattern, placement: model::Placement, width: u32, height: u32) -> Map<f64> {
    let plane = Plane { size: [width, height], seed: pattern.seed() };
    let shapes = pattern.shapes();
    Map::from_fn(width as usize, height as usize, |column, row| {
        let place = plane.place(column, row);
        match pattern {
            model::Pattern::Uniform { drawn } => drawn * placement.size,
            model::Pattern::Splash { .. } => plane.splash(place, &shapes),
            model::Pattern::Brush { width, .. } => plane.brush(place, 0.0, width),
            _ => 1.0,
        }
    })
}

struct Plane {
    size: [u32; 2],
    seed: u32,
}

impl Plane {
    fn shorter(&self) -> u32 {
        self.size[0].min(self.size[1])
    }

    /// Lengths of the edges, the shorter one 1.
    fn edges(&self) -> [f64; 2] {
        self.size.map(|edge| f64::from(edge) / f64::from(self.shorter()))
    }

    /// Tile coordinates of a texel's centre.
    #[expect(clippy::cast_precision_loss, reason = "texel indices are far below 2^53")]
    fn place(&self, column: usize, row: usize) -> [f64; 2] {
        let [width, height] = self.edges();
        let texel = 1.0 / f64::from(self.shorter());
        [(column as f64 + 0.5) * texel - 0.5 * width, 0.5 * height - (row as f64 + 0.5) * texel]
    }

    fn tiled_noise(&self, place: [f64; 2], count: u32, seed: u32) -> f64 {
        let shorter = self.shorter();
        // Rounded to whole lattice points, halves up.
        let period = self.size.map(|edge| (2 * count * edge + shorter) / (2 * shorter));
        let edges = self.edges();
        noise([0, 1].map(|axis| (place[axis] / edges[axis] + 0.5) * f64::from(period[axis])), period, seed)
    }

    fn outline(&self, place: [f64; 2], shape: &Capsule) -> f64 {
        let edges = self.edges();
        let axis = [0, 1].map(|i| shape.to[i] - shape.from[i]);
        let length2 = axis[0] * axis[0] + axis[1] * axis[1];
        let mut nearest: Option<(f64, f64)> = None;
        for shift in (0..9).map(|index| [index % 3 - 1, index / 3 - 1].map(f64::from)) {
            let from = [0, 1].map(|i| place[i] + shift[i] * edges[i] - shape.from[i]);
            let from_middle = (from[0] - 0.5 * axis[0]).hypot(from[1] - 0.5 * axis[1]);
            let part = if length2 > 0.0 { ((from[0] * axis[0] + from[1] * axis[1]) / length2).clamp(0.0, 1.0) } else { 0.0 };
            let apart = (from[0] - part * axis[0]).hypot(from[1] - part * axis[1]);
            let radius = (1.0 - part) * shape.radii[0] + part * shape.radii[1];
            if nearest.is_none_or(|(least, _)| from_middle < least) {
                nearest = Some((from_middle, apart - radius));
            }
        }
        nearest.map_or(f64::INFINITY, |(_, outline)| outline)
    }

    fn splash(&self, place: [f64; 2], shapes: &[Capsule]) -> f64 {
        let flow = 0.035;
        let distance = shapes.iter().map(|shape| self.outline(place, shape)).fold(1.0, |one: f64, other| {
            // The minimum, rounded off by a parabola where the two are closer than `flow`.
            if (one - other).abs() < flow { one.min(other) - (flow - (one - other).abs()).powi(2) / (4.0 * flow) } else { one.min(other) }
        });
        let fray =
            0.010 * (self.tiled_noise(place, 14, self.seed) - 0.5) + 0.004 * (self.tiled_noise(place, 45, self.seed.wrapping_add(1)) - 0.5);
        let depth = -distance - fray;
        let rim = (-((depth - 0.013) / 0.009).powi(2)).exp();
        let pool = 0.45 + 0.2 * self.tiled_noise(place, 7, self.seed.wrapping_add(2));
        smoothstep(0.0, 0.009, depth) * (pool + (1.0 - pool) * rim)
    }

    fn brush(&self, place: [f64; 2], angle: f64, width: f64) -> f64 {
        let turned = [place[0] * angle.cos() + place[1] * angle.sin(), place[1] * angle.cos() - place[0] * angle.sin()];
        let noise = |x: f64, y: f64, layer: u32| noise([x, y], [65536; 2], self.seed.wrapping_add(layer));
        let waver = 0.2 * width * (noise(4.0 * turned[0], 0.5, 0) - 0.5);
        let press = 0.5 * width * (0.92 + 0.16 * noise(9.0 * turned[0], 0.5, 1));
        let across = (turned[1] - waver) / press;
        let run = (turned[0] + 0.4) / 0.8;
        let mark = 0.45 * noise(3.0 * run, 6.0 * across, 2) + 0.55 * noise(5.0 * run, 19.0 * across, 3);
        let groove = smoothstep(0.1 + 0.3 * run, 0.5 + 0.25 * run, mark);
        let last = 0.66 + 0.34 * noise(0.5, 14.0 * across, 4);
        let first = 0.05 * across * across + 0.03 * noise(0.5, 9.0 * across, 5);
        let ends = smoothstep(first, first + 0.05, run) * (1.0 - smoothstep(last - 0.16, last, run));
        let side = 1.0 - smoothstep(0.86, 1.0, across.abs());
        let ridge = 0.3 * smoothstep(0.6, 0.85, across.abs()) + 0.3 * (1.0 - smoothstep(0.03, 0.16, run));
        let body = 0.3 * (1.0 - 1.3 * run).clamp(0.0, 1.0) + 0.6 * groove + ridge;
        ends * side * body.clamp(0.0, 1.0)
    }
}

/// Lattice values weighted by the four corners' cubic shares.
fn noise(place: [f64; 2], period: [u32; 2], seed: u32) -> f64 {
    let mut sum = 0.0;
    for corner in [[0, 0], [1, 0], [0, 1], [1, 1]] {
        let mut share = 1.0;
        let mut point = [0_u32; 2];
        for axis in 0..2 {
            let floor = place[axis].floor();
            let distance = (place[axis] - floor - f64::from(corner[axis])).abs();
            share *= 1.0 - smoothstep(0.0, 1.0, distance);
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an integer in 0..period")]
            let wrapped = (floor + f64::from(corner[axis])).rem_euclid(f64::from(period[axis])) as u32;
            point[axis] = wrapped;
        }
        sum += share * f64::from(hash(point[0] ^ hash(point[1] ^ hash(seed))) >> 8) / 16_777_216.0;
    }
    sum
}

fn smoothstep(low: f64, high: f64, value: f64) -> f64 {
    let t = ((value - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
