//! Twin of `plane`: a camera in space whose rays are cut with the base plane.

use glam::DVec3;

use super::Surface;
use crate::{
    data::{Map, PlaneView},
    model::Relief,
};

/// RGB (π·L_o/E times coverage) and coverage of each pixel of the picture `shot` of `surface`.
#[must_use]
#[expect(clippy::cast_precision_loss, reason = "columns and rows of a picture")]
pub fn plane(surface: &Surface, shot: &PlaneView, relief: Relief) -> Map<[f64; 4]> {
    let (width, height) = (surface.heights.width() as f64, surface.heights.height() as f64);
    let (columns, rows) = (shot.size[0] as usize, shot.size[1] as usize);
    let view = shot.view.vector();
    let up = (DVec3::Y - view * view.y).normalize();
    let right = up.cross(view);
    // The largest scale, in pixels a texel, at which each of the four corners is still inside.
    let scale = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)]
        .map(|(x, y)| {
            let corner = DVec3::new(x * width / 2.0, y * height / 2.0, 0.0);
            (columns as f64 / 2.0 / corner.dot(right).abs()).min(rows as f64 / 2.0 / corner.dot(up).abs())
        })
        .into_iter()
        .fold(f64::INFINITY, f64::min)
        * (1.0 - shot.margin);
    let field = surface.field();
    let samples = shot.samples.max(1);
    Map::from_fn(columns, rows, |column, row| {
        let mut sum = [0.0; 4];
        for sample in 0..samples * samples {
            let inside = |index: u32| (f64::from(index) + 0.5) / f64::from(samples);
            let x = (column as f64 + inside(sample % samples) - columns as f64 / 2.0) / scale;
            let y = (rows as f64 / 2.0 - row as f64 - inside(sample / samples)) / scale;
            let eye = right * x + up * y;
            let on_plane = eye - view * (eye.z / view.z);
            if on_plane.x.abs() > width / 2.0 || on_plane.y.abs() > height / 2.0 {
                continue;
            }
            let base = [on_plane.x + width / 2.0 - 0.5, height / 2.0 - 0.5 - on_plane.y];
            let radiance = surface.radiance(&field, base, shot.view.vector(), shot.light.vector(), relief);
            for (sum, value) in sum.iter_mut().zip(radiance.into_iter().chain([1.0])) {
                *sum += value / f64::from(samples * samples);
            }
        }
        sum
    })
}
