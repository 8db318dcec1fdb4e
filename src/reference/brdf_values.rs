//! Twin of `brdf_values`.

use crate::data::Direction;

/// π·f_r of `radiance` in reflectance units under `light` (thesis eq. 3.5): the cosine is that of the angle, where the kernel
/// multiplies by a reciprocal. −1 of a masked (negative) radiance.
#[must_use]
pub fn brdf_values(radiance: f64, light: Direction) -> f64 {
    if radiance < 0.0 { -1.0 } else { radiance / light.theta.cos() }
}
