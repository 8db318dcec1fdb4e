//! Patterns: how thick a layer is drawn, from 0 (bare) to 1.
//!
//! A pattern has coordinates of its own, in which it is drawn at any resolution: the origin in its middle, x right, y up, and 1 the
//! shorter edge of the cell that it fills at size 1 ([`Placement`]).

use std::f64::consts::TAU;

/// What is drawn. Lengths are in the pattern's own coordinates, in which the shorter edge of its cell is 1 ([`Placement`]).
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum Pattern {
    /// The same thickness everywhere.
    Uniform {
        /// The drawn thickness, 0 to 1.
        drawn: f64,
    },
    /// An image: black is bare, white is 1. It keeps its shape, and is as large as fits into its cell.
    Image {
        /// Its index among the images of the recipe.
        image: usize,
    },
    /// A splash: overlapping blobs, fingers thrown out of them, drops around, the paint thickest at the rims.
    Splash {
        /// Another number, another splash.
        seed: u32,
    },
    /// A flower: petals around a centre, each with its veins, thickest at their rims.
    Flower {
        /// Another number, another flower.
        seed: u32,
        /// Number of petals, 3 to 16.
        petals: u32,
    },
    /// One stroke of a brush through the middle, from left to right, with the marks of its bristles, running dry at its end.
    Brush {
        /// Another number, another stroke.
        seed: u32,
        /// Width of the stroke, 0.01 to 0.5.
        width: f64,
    },
    /// Drops of all sizes, flicked from a brush, many small ones and few large ones.
    Spatter {
        /// Another number, other drops.
        seed: u32,
        /// Part of the cell that is covered, about, above 0 up to 0.9.
        cover: f64,
    },
    /// Stripes from left to right.
    Stripes {
        /// Number of stripes along the shorter edge of the cell, 1 to 1000.
        count: u32,
        /// Part of their distance that is painted, above 0 and below 1.
        width: f64,
    },
    /// Cloudy noise between 0 and 1.
    Noise {
        /// Another number, other clouds.
        seed: u32,
        /// Number of the largest clouds along the shorter edge of the cell, 1 to 1000.
        count: u32,
    },
}

/// A pattern or placement that cannot be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("the setting \"{setting}\" of {of} is {found}; it must be {expected}")]
pub struct PatternError {
    /// "stripes", "a brush stroke", "a placement" and so on.
    pub of: &'static str,
    /// Which setting, by its name in recipes.
    pub setting: &'static str,
    /// The value.
    pub found: f64,
    /// What is allowed.
    pub expected: &'static str,
}

/// A round-ended capsule whose radius goes over linearly from one end to the other; lengths in the pattern's coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Capsule {
    /// Centre of one end.
    pub from: [f64; 2],
    /// Centre of the other end.
    pub to: [f64; 2],
    /// Radii at the ends.
    pub radii: [f64; 2],
}

impl Capsule {
    /// A lower bound of the distance from `place` to its outline: it counts as thick as it is anywhere.
    #[must_use]
    pub fn least_distance(&self, place: [f64; 2]) -> f64 {
        let axis = [0, 1].map(|i| self.to[i] - self.from[i]);
        let from = [0, 1].map(|i| place[i] - self.from[i]);
        let length2 = axis[0] * axis[0] + axis[1] * axis[1];
        let part = if length2 > 0.0 { ((from[0] * axis[0] + from[1] * axis[1]) / length2).clamp(0.0, 1.0) } else { 0.0 };
        (from[0] - part * axis[0]).hypot(from[1] - part * axis[1]) - self.radii[0].max(self.radii[1])
    }
}

impl Pattern {
    /// Points that the coarsest lattice of a spatter has along the shorter edge of its cell.
    pub const SPATTER_LATTICE: u32 = 6;

    /// The name of its kind, as recipes have it.
    #[must_use]
    pub fn kind(self) -> &'static str {
        match self {
            Self::Uniform { .. } => "uniform",
            Self::Splash { .. } => "splash",
            Self::Brush { .. } => "brush",
            Self::Flower { .. } => "flower",
            Self::Spatter { .. } => "spatter",
            Self::Stripes { .. } => "stripes",
            Self::Noise { .. } => "noise",
            Self::Image { .. } => "image",
        }
    }

    /// The seed; 0 where chance has no part.
    #[must_use]
    pub fn seed(self) -> u32 {
        match self {
            Self::Uniform { .. } | Self::Image { .. } | Self::Stripes { .. } => 0,
            Self::Splash { seed }
            | Self::Flower { seed, .. }
            | Self::Brush { seed, .. }
            | Self::Spatter { seed, .. }
            | Self::Noise { seed, .. } => seed,
        }
    }

    /// The pattern itself, if its settings are in range.
    ///
    /// # Errors
    /// [`PatternError`] for the first that is not.
    pub fn checked(self) -> Result<Self, PatternError> {
        let refused = |of, setting, found, expected| Err(PatternError { of, setting, found, expected });
        match self {
            Self::Uniform { drawn } if !(0.0..=1.0).contains(&drawn) => {
                refused("a uniform pattern", "drawn", drawn, "at least 0 and at most 1")
            }
            Self::Flower { petals, .. } if !(3..=16).contains(&petals) => {
                refused("a flower", "petals", petals.into(), "at least 3 and at most 16")
            }
            Self::Brush { width, .. } if !(0.01..=0.5).contains(&width) => {
                refused("a brush stroke", "width", width, "at least 0.01 and at most 0.5 of the cell's shorter edge")
            }
            Self::Spatter { cover, .. } if !(cover > 0.0 && cover <= 0.9) => {
                refused("a spatter", "cover", cover, "above 0 and at most 0.9")
            }
            Self::Stripes { count, .. } if !(1..=1000).contains(&count) => {
                refused("stripes", "count", count.into(), "at least 1 and at most 1000")
            }
            Self::Stripes { width, .. } if !(width > 0.0 && width < 1.0) => refused("stripes", "width", width, "above 0 and below 1"),
            Self::Noise { count, .. } if !(1..=1000).contains(&count) => {
                refused("noise", "count", count.into(), "at least 1 and at most 1000")
            }
            _ => Ok(self),
        }
    }

    /// The shapes that flow together into the pattern; none unless it is a splash. All lie within 0.45 of the
    /// middle.
    #[must_use]
    pub fn shapes(self) -> Vec<Capsule> {
        match self {
            Self::Splash { seed } => splash(seed),
            _ => Vec::new(),
        }
    }
}

fn splash(seed: u32) -> Vec<Capsule> {
    let mut draws = (0..).map(|index| f64::from(hash(seed ^ hash(index)) >> 8) / f64::from(1 << 24));
    let mut between = |low: f64, high: f64| low + (high - low) * draws.next().unwrap_or_default();
    let at = |radius: f64, angle: f64| [radius * angle.cos(), radius * angle.sin()];
    let mut shapes = Vec::new();
    for _ in 0..5 {
        let centre = at(between(0.0, 0.12), between(0.0, TAU));
        let radius = between(0.06, 0.12);
        shapes.push(Capsule { from: centre, to: centre, radii: [radius, radius] });
    }
    // Fingers: thrown outwards, thin, with a bead at the tip.
    for finger in 0..11 {
        let angle = TAU * (f64::from(finger) + between(-0.4, 0.4)) / 11.0;
        let (reach, neck) = (between(0.2, 0.36), between(0.006, 0.014));
        let (root, tip) = (at(0.08, angle), at(reach, angle + between(-0.08, 0.08)));
        shapes.push(Capsule { from: root, to: tip, radii: [3.0 * neck, neck] });
        let bead = neck * between(1.2, 2.2);
        shapes.push(Capsule { from: tip, to: tip, radii: [bead, bead] });
    }
    // Drops: many small ones, few large ones, drawn out along their flight.
    for _ in 0..40 {
        let (reach, angle) = (between(0.22, 0.43), between(0.0, TAU));
        let radius = 0.004 + 0.018 * between(0.0, 1.0).powi(3);
        let tail = radius * between(0.2, 1.6);
        shapes.push(Capsule { from: at(reach - tail, angle), to: at(reach, angle), radii: [0.6 * radius, radius] });
    }
    shapes
}

/// A bijection of 32 bits whose output looks random (lowbias32, the hash of `kernels/common/noise.wgsl`).
#[must_use]
pub fn hash(value: u32) -> u32 {
    let mut x = value;
    x = (x ^ (x >> 16)).wrapping_mul(0x7feb_352d);
    x = (x ^ (x >> 15)).wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}
