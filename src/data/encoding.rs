//! How stored values become radiance.

use half::f16;

use super::Direction;

/// How stored values become linear light.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Transfer {
    /// The sRGB curve, IEC 61966-2-1.
    Srgb,
    /// linear = stored^γ.
    Gamma(f64),
    /// Already linear.
    Linear,
}

/// Which row is stored first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RowOrder {
    /// The top row.
    TopDown,
    /// The bottom row.
    BottomUp,
}

/// How a source's stored values become radiance in reflectance units (π L/E: a white Lambertian surface lit from θ has cos θ). A reader
/// says what it found or takes for granted, a user may know better.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Encoding {
    /// From stored values to linear ones.
    pub transfer: Transfer,
    /// Whether the stored values have the light's cosine in them, as photographs do. Where they do not, it is multiplied in.
    pub includes_cosine: bool,
    /// Which row is stored first.
    pub rows: RowOrder,
    /// Linear values are multiplied by this.
    pub scale: f64,
    /// Texels a millimetre of the material, where the source says so.
    pub texels_per_mm: Option<f64>,
}

impl Encoding {
    /// What photographs have: the cosine within, the top row first, no other unit.
    #[must_use]
    pub fn photograph(transfer: Transfer) -> Self {
        Self { transfer, includes_cosine: true, rows: RowOrder::TopDown, scale: 1.0, texels_per_mm: None }
    }

    /// What linear values of a sample under `light` are multiplied by to be radiance in reflectance units.
    #[must_use]
    pub fn factor(&self, light: Direction) -> f64 {
        if self.includes_cosine { self.scale } else { self.scale * light.theta.cos() }
    }

    /// The linear value of a stored one, both before [`Self::factor`]; what lies outside 0 to 1 is continued by the curve, mirrored below 0.
    #[must_use]
    pub fn linear(&self, stored: f64) -> f64 {
        match self.transfer {
            Transfer::Srgb => crate::model::color::linear_from_srgb(stored.abs()).copysign(stored),
            Transfer::Gamma(gamma) => stored.abs().powf(gamma).copysign(stored),
            Transfer::Linear => stored,
        }
    }
}

/// A measured value as the half that a sample stores: rounded to the nearest, but what is finite stays finite (at most 65504) and what is
/// negative stays negative, since a negative half, an infinite one and NaN are no radiance.
#[must_use]
pub fn radiance_half(value: f64) -> f16 {
    if !value.is_finite() {
        return f16::from_f64(value);
    }
    let half = f16::from_f64(value.clamp(f64::from(f16::MIN), f64::from(f16::MAX)));
    match half.to_f64() == 0.0 {
        true if value < 0.0 => -f16::MIN_POSITIVE_SUBNORMAL,
        true => f16::ZERO,
        false => half,
    }
}
