//! Twin of `shading`.

use glam::DVec3;

use super::{SeenPoint, relief::HeightField};
use crate::{
    data::{Direction, Map},
    model::{Boundary, Relief},
};

/// cos θ_i at a point of the field `heights` times the share of the light that reaches it.
#[must_use]
pub fn shading(heights: &Map<f64>, boundary: Boundary, point: SeenPoint, light: Direction, relief: Relief) -> f64 {
    let light = light.vector();
    let cosine = DVec3::from_array(point.normal).dot(light).max(0.0);
    if relief.shadow {
        cosine * HeightField::new(heights, boundary).seen_share(point.place, point.height, light, relief.penumbra)
    } else {
        cosine
    }
}
