//! Twin of `normals`: slopes as derivatives of the parabola through three neighbours, in f64.

use crate::{data::Map, model::Boundary};

/// Unit normals of `heights` (texel widths): n ∝ (−∂z/∂x, −∂z/∂y, 1), y upwards.
#[must_use]
pub fn normals(heights: &Map<f64>, boundary: Boundary) -> Map<[f64; 3]> {
    Map::from_fn(heights.width(), heights.height(), |column, row| {
        let at = |dx: isize, dy: isize| {
            let x = boundary.wrap(column.cast_signed() + dx, heights.width());
            let y = boundary.wrap(row.cast_signed() + dy, heights.height());
            heights[(x, y)]
        };
        // Lagrange's parabola through (-1, a), (0, b), (1, c) has the slope (c - a)/2 at 0.
        let slope = |before: f64, here: f64, after: f64| {
            let curvature = before - 2.0 * here + after;
            (after - here) - 0.5 * curvature
        };
        let p = slope(at(-1, 0), at(0, 0), at(1, 0));
        let q = slope(at(0, 1), at(0, 0), at(0, -1));
        let length = (p * p + q * q + 1.0).sqrt();
        [-p / length, -q / length, 1.0 / length]
    })
}
