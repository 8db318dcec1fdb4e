//! sRGB: its transfer curve, and its primaries in CIE XYZ.

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

/// Linear sRGB of CIE XYZ of 1931, both with the white of D65, Y = 1 (IEC 61966-2-1:1999, amendment 1, F.2). Colours outside sRGB have
/// negative values.
#[must_use]
pub fn linear_from_xyz([x, y, z]: [f64; 3]) -> [f64; 3] {
    [
        3.240_625_5 * x - 1.537_208_0 * y - 0.498_628_6 * z,
        -0.968_930_7 * x + 1.875_756_1 * y + 0.041_517_5 * z,
        0.055_710_1 * x - 0.204_021_1 * y + 1.056_995_9 * z,
    ]
}
