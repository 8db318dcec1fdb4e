//! Splash and brush stroke.

use super::marks::{Marks, edge, grain, smoothstep};
use crate::model::Capsule;

/// Distance from `place` to a capsule's outline, negative inside.
fn outline(place: [f64; 2], shape: &Capsule) -> f64 {
    let axis = [0, 1].map(|i| shape.to[i] - shape.from[i]);
    let apart = [0, 1].map(|i| place[i] - shape.from[i]);
    let length = axis[0].hypot(axis[1]);
    if length == 0.0 {
        return apart[0].hypot(apart[1]) - shape.radii[0];
    }
    // Along and across the axis.
    let along = (apart[0] * axis[0] + apart[1] * axis[1]) / length;
    let across = (apart[1] * axis[0] - apart[0] * axis[1]) / length;
    let part = (along / length).clamp(0.0, 1.0);
    (along - part * length).hypot(across) - (1.0 - part) * shape.radii[0] - part * shape.radii[1]
}

impl Marks {
    pub(super) fn splash(self, place: [f64; 2], shapes: &[Capsule]) -> f64 {
        let flow = 0.05;
        let sum: f64 = shapes.iter().map(|shape| (1.0 - outline(place, shape).min(flow) / flow).powi(4)).sum();
        let distance = flow * (1.0 - sum.powf(0.25));
        let fray = 0.010 * (self.grain(place, [14.0; 2], 0) - 0.5) + 0.004 * (self.grain(place, [45.0; 2], 1) - 0.5);
        let depth = -distance - fray;
        let pool = 0.3 + 0.3 * self.grain(place, [7.0; 2], 2) + 0.2 * self.grain(place, [19.0; 2], 3);
        let rim = self.ridge(depth - 0.013, 0.009);
        self.edge(0.0, 0.009, depth) * (pool + (1.0 - pool) * rim)
    }

    pub(super) fn brush(self, place: [f64; 2], width: f64) -> f64 {
        let waver = 0.2 * width * (self.grain([place[0], 0.5], [4.0, 1.0], 0) - 0.5);
        let press = 0.5 * width * (0.92 + 0.16 * self.grain([place[0], 0.5], [9.0, 1.0], 1));
        let across = (place[1] - waver) / press;
        let run = (place[0] + 0.39) / 0.78;
        let (texel_across, texel_run) = (self.texel / press, self.texel / 0.78);
        let bristle = |x: f64, cells: [f64; 2], index: u32| grain([x, across], cells, self.seed.wrapping_add(index), texel_across);
        let mark = 0.4 * bristle(run, [3.0, 6.0], 2) + 0.4 * bristle(run, [5.0, 19.0], 3) + 0.2 * bristle(run, [7.0, 47.0], 4);
        let groove = smoothstep(0.1 + 0.3 * run, 0.5 + 0.25 * run, mark);
        let last = 0.66 + 0.34 * bristle(0.5, [1.0, 14.0], 5);
        let first = 0.05 * across * across + 0.03 * bristle(0.5, [1.0, 9.0], 6);
        let ends = edge(first, first + 0.05, run, texel_run) * (1.0 - edge(last - 0.16, last, run, texel_run));
        let side = 1.0 - edge(0.86, 1.0, across.abs(), texel_across);
        let border = 0.3 * edge(0.6, 0.85, across.abs(), texel_across) + 0.3 * (1.0 - edge(0.03, 0.16, run, texel_run));
        let body = 0.3 * (1.0 - 1.3 * run).clamp(0.0, 1.0) + 0.6 * groove + border;
        ends * side * body.clamp(0.0, 1.0)
    }
}
