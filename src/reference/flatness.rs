//! Twin of `flatness`.

use crate::{data::Map, model::Boundary};

/// Mean over the 5 × 5 texels around each of tan² of the normal's angle plus the square of the five-point Laplacian.
#[must_use]
pub fn flatness(heights: &Map<f64>, normals: &Map<[f64; 3]>, boundary: Boundary) -> Map<f64> {
    let (width, height) = (heights.width(), heights.height());
    let z = |x: isize, y: isize| heights[(boundary.wrap(x, width), boundary.wrap(y, height))];
    let bend = |x: isize, y: isize| {
        let cosine: f64 = normals[(boundary.wrap(x, width), boundary.wrap(y, height))][2];
        let laplacian = z(x - 1, y) + z(x + 1, y) + z(x, y - 1) + z(x, y + 1) - 4.0 * z(x, y);
        cosine.powi(-2) - 1.0 + laplacian * laplacian
    };
    Map::from_fn(width, height, |column, row| {
        let (column, row) = (column.cast_signed(), row.cast_signed());
        (row - 2..=row + 2).map(|y| (column - 2..=column + 2).map(|x| bend(x, y)).sum::<f64>()).sum::<f64>() / 25.0
    })
}
