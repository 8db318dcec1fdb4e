//! Twin of `shading`.

use glam::DVec3;

use super::{SeenPoint, relief::HeightField};
use crate::{
    data::{Direction, Map},
    model::{Boundary, Relief},
};

/// cos θ_i at a point of the field `heights` times the share of the light that reaches it, and the share `ambient` of the base plane's.
#[must_use]
pub fn shading(heights: &Map<f64>, boundary: Boundary, point: SeenPoint, light: Direction, relief: Relief, ambient: f64) -> f64 {
    let light = light.vector();
    let cosine = DVec3::from_array(point.normal).dot(light).max(0.0);
    let seen =
        if relief.shadow { HeightField::new(heights, boundary).seen_share(point.place, point.height, light, relief.penumbra) } else { 1.0 };
    (1.0 - ambient) * cosine * seen + ambient * light.z
}
