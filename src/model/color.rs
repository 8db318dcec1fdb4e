//! The transfer curve between linear light and sRGB codes.

/// The sRGB value in 0..=1 of a linear value in 0..=1 (IEC 61966-2-1:1999, 5.2).
#[must_use]
pub fn srgb_from_linear(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// The linear value in 0..=1 of an sRGB value in 0..=1 (IEC 61966-2-1:1999, 5.2).
#[must_use]
pub fn linear_from_srgb(srgb: f64) -> f64 {
    if srgb <= 0.040_45 { srgb / 12.92 } else { ((srgb + 0.055) / 1.055).powf(2.4) }
}
