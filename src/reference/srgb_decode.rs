//! Twin of `srgb_decode`: the curve in f64.

use crate::model::color::linear_from_srgb;

/// Linear value of an 8-bit sRGB code (IEC 61966-2-1).
#[must_use]
pub fn srgb_decode(code: u8) -> f64 {
    linear_from_srgb(f64::from(code) / 255.0)
}
