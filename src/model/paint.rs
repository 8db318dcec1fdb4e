//! Paints and layers: what is laid on a material.

use super::{Coat, Film, Pattern, Placement, kubelka_munk::film_of, pigments::Pigment};

/// A paint by its Kubelka-Munk coefficients per unit of thickness, in R, G, B.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Paint {
    /// Name shown to the user.
    pub name: String,
    /// Absorption K.
    pub k: [f64; 3],
    /// Scattering S.
    pub s: [f64; 3],
}

impl From<&Pigment> for Paint {
    fn from(pigment: &Pigment) -> Self {
        Self { name: pigment.full_name(), k: pigment.k, s: pigment.s }
    }
}

impl Paint {
    /// The least difference of a film over white and over black that two colours of 8 bits tell.
    pub const LEAST_DIFFERENCE: f64 = 1.0 / 255.0;

    /// The paint of which a film of `thickness` reflects `over_white` on a white ground and `over_black` on a black one, in R, G, B of
    /// linear light (Curtis et al. 1997, section 5.1).
    ///
    /// A film over white and over black that differ by less than `least_difference`, such as [`Self::LEAST_DIFFERENCE`], is refused:
    /// the nearer they are, the more of S lies in their last digits. 0 takes both as exact.
    ///
    /// # Errors
    /// [`PaintError`] unless 0 < R_b < R_w < 1 in each channel, for the first that differs too little, and as [`Self::checked`].
    pub fn from_reflectances(
        name: &str, over_white: [f64; 3], over_black: [f64; 3], thickness: f64, least_difference: f64,
    ) -> Result<Self, PaintError> {
        let mut paint = Self { name: name.to_owned(), k: [0.0; 3], s: [0.0; 3] };
        for (index, channel) in CHANNELS.into_iter().enumerate() {
            let (over_white, over_black) = (over_white[index], over_black[index]);
            let Some((s, k)) = film_of(over_white, over_black) else {
                return Err(PaintError::Reflectances { paint: paint.name, channel, over_white, over_black });
            };
            if over_white - over_black < least_difference {
                return Err(PaintError::Opaque { paint: paint.name, channel, over_white, over_black, least: least_difference });
            }
            (paint.s[index], paint.k[index]) = (s / thickness, k / thickness);
        }
        paint.checked()
    }

    /// `parts` of paints stirred together: K = Σcᵢ·Kᵢ and S = Σcᵢ·Sᵢ, amounts cᵢ above 0, divided by their sum (Duncan 1940).
    ///
    /// All must be in one unit of thickness, the mixture is in the same.
    ///
    /// # Errors
    /// As [`Self::checked`].
    pub fn mixture(name: &str, parts: &[(f64, Self)]) -> Result<Self, PaintError> {
        let whole: f64 = parts.iter().map(|(amount, _)| amount).sum();
        let mean = |of: fn(&Self) -> &[f64; 3]| {
            std::array::from_fn(|channel| parts.iter().map(|(amount, paint)| amount * of(paint)[channel]).sum::<f64>() / whole)
        };
        Self { name: name.to_owned(), k: mean(|paint| &paint.k), s: mean(|paint| &paint.s) }.checked()
    }

    /// The paint itself, if K and S are at least 0 and at most 1e6.
    ///
    /// # Errors
    /// [`PaintError::Coefficient`] for the first that is not.
    pub fn checked(self) -> Result<Self, PaintError> {
        for (coefficient, values) in [("K", self.k), ("S", self.s)] {
            for (channel, found) in CHANNELS.into_iter().zip(values) {
                if !(0.0..=MAX_COEFFICIENT).contains(&found) {
                    return Err(PaintError::Coefficient { paint: self.name, coefficient, channel, found });
                }
            }
        }
        Ok(self)
    }

    /// The film of `thickness` in R, G, B.
    #[must_use]
    pub fn films(&self, thickness: f64) -> [Film; 3] {
        std::array::from_fn(|channel| Film::new(self.s[channel] * thickness, self.k[channel] * thickness))
    }
}

/// One layer of paint. A pattern draws its thickness in [0, 1]; two scales, independent of each other, give that drawing
/// its optical and its geometric size.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Layer {
    /// The paint.
    pub paint: Paint,
    /// What is drawn.
    pub pattern: Pattern,
    /// Where it is drawn.
    pub placement: Placement,
    /// Kubelka-Munk thickness d where the drawn thickness is 1, in the unit of the paint's coefficients: d = thickness·drawn.
    pub thickness: f64,
    /// Height in texel widths where the drawn thickness is 1: the surface rises by relief·drawn.
    pub relief: f64,
    /// Refractive index n of the binder.
    pub refractive_index: f64,
    /// Width α of the surface's GGX lobe.
    pub roughness: f64,
}

/// A paint or layer that cannot be.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PaintError {
    /// A coefficient is negative, not finite, or too large.
    #[error("{coefficient} of paint \"{paint}\" in {channel} is {found}; it must be at least 0 and at most {MAX_COEFFICIENT:e}")]
    Coefficient {
        /// The paint's name.
        paint: String,
        /// "K" or "S".
        coefficient: &'static str,
        /// "red", "green" or "blue".
        channel: &'static str,
        /// The value.
        found: f64,
    },
    /// Reflectances that no film has.
    #[error(
        "paint \"{paint}\" in {channel} reflects {white} over white and {black} over black; in linear light 0 < over black < over white < 1 \
         must hold in each channel: no film reflects nothing or everything, nor more over black than over white; measure again, or give K and S",
        white = short(*over_white), black = short(*over_black)
    )]
    Reflectances {
        /// The paint's name.
        paint: String,
        /// "red", "green" or "blue".
        channel: &'static str,
        /// R_w.
        over_white: f64,
        /// R_b.
        over_black: f64,
    },
    /// Reflectances of a film that is all but opaque, which do not tell S.
    #[error(
        "paint \"{paint}\" in {channel} reflects {white} over white and {black} over black, a difference of less than {least:.4}: the film \
         is all but opaque and does not tell its scattering; measure a thinner one",
        white = short(*over_white), black = short(*over_black)
    )]
    Opaque {
        /// The paint's name.
        paint: String,
        /// "red", "green" or "blue".
        channel: &'static str,
        /// R_w.
        over_white: f64,
        /// R_b.
        over_black: f64,
        /// The difference asked for.
        least: f64,
    },
    /// A setting of a layer lies outside its range.
    #[error("{setting} of the layer of \"{paint}\" is {found}; it must be at least {low} and at most {most}", most = short(*high))]
    Setting {
        /// The paint's name.
        paint: String,
        /// Which setting.
        setting: &'static str,
        /// The value.
        found: f64,
        /// Smallest value allowed.
        low: f64,
        /// Largest value allowed.
        high: f64,
    },
}

/// A number for a message: to six decimals, large ones by their exponent.
fn short(value: f64) -> String {
    if value.abs() >= 1e5 { format!("{value:e}") } else { ((value * 1e6).round() / 1e6).to_string() }
}

const CHANNELS: [&str; 3] = ["red", "green", "blue"];

/// Largest K, S, thickness and relief: far beyond opaque, and K·d stays within f32.
const MAX_COEFFICIENT: f64 = 1e6;

impl Layer {
    /// Drawn thickness from which a layer counts as closed; below it, the ground's own surface shows between the paint.
    pub const CLOSED: f64 = 0.05;

    /// A layer of the same thickness everywhere, with the binder of common paints: refractive index 1.5, roughness 0.3.
    #[must_use]
    pub fn new(paint: Paint, thickness: f64, relief: f64) -> Self {
        let Coat { refractive_index, roughness } = Coat::default();
        let pattern = Pattern::Uniform { drawn: 1.0 };
        Self { paint, pattern, placement: Placement::default(), thickness, relief, refractive_index, roughness }
    }

    /// Its surface.
    #[must_use]
    pub fn coat(&self) -> Coat {
        Coat { refractive_index: self.refractive_index, roughness: self.roughness }
    }

    /// Its colour to whoever takes paint for a colour: where it is drawn in full, over white.
    #[must_use]
    pub fn colour(&self) -> [f64; 3] {
        self.films(1.0).map(|film| film.over_substrate(1.0))
    }

    /// The layer itself, if every number is in its range.
    ///
    /// # Errors
    /// [`PaintError`] for the first that is not.
    pub fn checked(mut self) -> Result<Self, PaintError> {
        self.paint = self.paint.checked()?;
        let settings = [
            ("thickness", self.thickness, 0.0, MAX_COEFFICIENT),
            ("relief", self.relief, 0.0, MAX_COEFFICIENT),
            ("refractive index", self.refractive_index, 1.0, 4.0),
            // A narrower lobe than 0.01 falls between the texels of any picture.
            ("roughness", self.roughness, 0.01, 1.0),
        ];
        match settings.into_iter().find(|(_, found, low, high)| !(low..=high).contains(&found)) {
            Some((setting, found, low, high)) => Err(PaintError::Setting { paint: self.paint.name, setting, found, low, high }),
            None => Ok(self),
        }
    }

    /// The film in R, G, B where the drawn thickness is `drawn`.
    #[must_use]
    pub fn films(&self, drawn: f64) -> [Film; 3] {
        self.paint.films(self.thickness * drawn)
    }

    /// Texel widths by which the surface rises where the drawn thickness is `drawn`.
    #[must_use]
    pub fn rise(&self, drawn: f64) -> f64 {
        self.relief * drawn
    }
}

/// What paint does to what lies below it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PaintMethod {
    /// It absorbs and scatters light (Kubelka, Munk 1931), raises the surface and has a highlight of its own.
    #[default]
    KubelkaMunk,
    /// The naive way, for comparison: its colour is mixed into the picture by the drawn thickness, flat and without shading.
    AlphaBlend,
}

impl std::fmt::Display for PaintMethod {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.write_str(match self {
            Self::KubelkaMunk => "Kubelka-Munk",
            Self::AlphaBlend => "alpha blending",
        })
    }
}
