//! The form of a prefiltered environment, in which a rough surface finds its reflection with one look-up.
//!
//! What a surface reflects of an environment L is ∫ L(l) f(l, v) n·l dl. Karis 2013 ("Real shading in Unreal Engine 4") splits it into two
//! factors: the mean of L over a lobe about the mirrored view R, weighted by D(n·h) n·l at n = v = R, and the directional albedo of the
//! surface, F₀·scale + bias. The first is kept for some roughnesses and all R, the second for all roughnesses and views.
//!
//! Where the environment is the same everywhere the product is exact. Otherwise the lobe lacks the stretching along the view's plane that
//! grazing views see, it is not cut off at the surface's horizon, and straight down its mean cosine is up to 7 % above that of the
//! microfacets, whose masking replaces n·l.
//!
//! At roughness α = 1 the lobe at n = v = R is the cosine lobe: the roughest level looked up with the normal is the irradiance over π, what
//! a white Lambertian surface there reads.

/// Levels of a prefiltered environment, from the smoothest to the roughest.
pub const ENVIRONMENT_LEVELS: usize = 8;

/// Columns and rows of a level, an octahedral map: texels are 1.8° to 4.1° wide, the smoothest level's lobe at half its height 3.9°.
pub const ENVIRONMENT_SIZE: usize = 64;

/// Columns and rows of the equirectangular map that levels are summed from.
pub const ENVIRONMENT_SOURCE: [usize; 2] = [256, 128];

/// Roughnesses and cosines in a table of directional albedos.
pub const ALBEDO_SIZE: usize = 32;

/// Levels in which the roughness doubles.
const LEVELS_AN_OCTAVE: f64 = 4.0 / 3.0;

/// Roughness α of a level: α = 2^(3/4 (level - 7)), from 0.026 to 1. Linear between two levels, a small light's brightest reflection is at
/// most 14 % off.
#[must_use]
pub fn environment_roughness(level: usize) -> f64 {
    ((level as f64 - (ENVIRONMENT_LEVELS - 1) as f64) / LEVELS_AN_OCTAVE).exp2()
}

/// The level, with a fraction, of a roughness α; what is smoother than the smoothest counts as that.
#[must_use]
pub fn environment_level(roughness: f64) -> f64 {
    let last = (ENVIRONMENT_LEVELS - 1) as f64;
    (last + LEVELS_AN_OCTAVE * roughness.log2()).clamp(0.0, last)
}

/// Roughness α, or cosine, of a row or column of a table of directional albedos: the square of even steps from 0 to 1, close where the
/// albedo changes fast.
#[must_use]
pub fn albedo_node(index: usize) -> f64 {
    (index as f64 / (ALBEDO_SIZE - 1) as f64).powi(2)
}
