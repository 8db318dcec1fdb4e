//! Twin of `reconstruct`.

use super::Surface;
use crate::{
    data::{Direction, Map},
    model::Relief,
};

/// π·L_o/E per pixel: what an orthographic camera records of `surface` along `view`, rectified to the base plane.
#[must_use]
#[expect(clippy::cast_precision_loss, reason = "columns and rows of a picture")]
pub fn reconstruct(surface: &Surface, view: Direction, light: Direction, relief: Relief) -> Map<[f64; 3]> {
    let field = surface.field();
    Map::from_fn(surface.heights.width(), surface.heights.height(), |column, row| {
        surface.radiance(&field, [column as f64, row as f64], view.vector(), light.vector(), relief)
    })
}
