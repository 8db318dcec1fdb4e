//! Twin of `seen_surface`: exact crossings with the bilinear patches.

use glam::DVec3;

use super::relief::HeightField;
use crate::{
    data::{Direction, Map},
    model::Boundary,
};

/// A point of a height field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeenPoint {
    /// Column and row, texels.
    pub place: [f64; 2],
    /// Texel widths.
    pub height: f64,
    /// Unit normal, bilinear between those of the texels.
    pub normal: [f64; 3],
}

/// The point of the field `heights` with `normals` that `view` sees through `base` (column, row) of the base plane, or the one right above
/// it if `view` is none.
#[must_use]
pub fn seen_surface(heights: &Map<f64>, normals: &Map<[f64; 3]>, boundary: Boundary, base: [f64; 2], view: Option<Direction>) -> SeenPoint {
    let field = HeightField::new(heights, boundary);
    let (place, height) = view.map_or_else(|| (base, field.at(base)), |view| field.first_hit(base, view.vector()));
    let normal = field.corners(place).into_iter().map(|(texel, weight)| weight * DVec3::from_array(normals[texel])).sum::<DVec3>();
    SeenPoint { place, height, normal: normal.normalize().to_array() }
}
