//! Patterns: how thick a layer is drawn, from 0 (bare) to 1, over a plane that repeats.
//!
//! Patterns live in tile coordinates: the origin at the middle of the plane, x right, y up, the plane's shorter edge of length
//! 1, so that round shapes stay round and the same pattern is drawn at any resolution.

use std::f64::consts::TAU;

/// What is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pattern {
    /// Thickness 1 everywhere.
    Uniform,
    /// A splash: overlapping blobs, fingers thrown out of them, drops around, the paint thickest at the rims.
    Splash {
        /// Another number, another splash.
        seed: u32,
    },
    /// One stroke of a brush through the middle, with the marks of its bristles, running dry at its end.
    Brush {
        /// Another number, another stroke.
        seed: u32,
        /// Direction of the stroke, counter-clockwise from +x, radians.
        angle: f64,
        /// Width of the stroke; the shorter edge of the plane is 1.
        width: f64,
    },
}

/// A pattern that cannot be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("the {setting} of a brush stroke is {found}; it must be {expected}")]
pub struct PatternError {
    /// Which setting.
    pub setting: &'static str,
    /// The value.
    pub found: f64,
    /// What is allowed.
    pub expected: &'static str,
}

/// A round-ended capsule whose radius goes over linearly from one end to the other; lengths in tile coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Capsule {
    /// Centre of one end.
    pub from: [f64; 2],
    /// Centre of the other end.
    pub to: [f64; 2],
    /// Radii at the ends.
    pub radii: [f64; 2],
}

impl Pattern {
    /// The code that the kernel knows it by (`kernels/pattern.wgsl`).
    #[must_use]
    pub fn code(self) -> u32 {
        match self {
            Self::Uniform => 0,
            Self::Splash { .. } => 1,
            Self::Brush { .. } => 2,
        }
    }

    /// The seed; 0 where chance has no part.
    #[must_use]
    pub fn seed(self) -> u32 {
        match self {
            Self::Uniform => 0,
            Self::Splash { seed } | Self::Brush { seed, .. } => seed,
        }
    }

    /// The pattern itself, if its settings are in range.
    ///
    /// # Errors
    /// [`PatternError`] for the first that is not.
    pub fn checked(self) -> Result<Self, PatternError> {
        if let Self::Brush { angle, width, .. } = self {
            if !angle.is_finite() {
                return Err(PatternError { setting: "angle", found: angle, expected: "finite" });
            }
            if !(0.01..=0.5).contains(&width) {
                return Err(PatternError {
                    setting: "width",
                    found: width,
                    expected: "at least 0.01 and at most 0.5 of the plane's shorter edge",
                });
            }
        }
        Ok(self)
    }

    /// The shapes that flow together into the pattern; none unless it is a splash. All lie within 0.45 of the middle.
    #[must_use]
    pub fn shapes(self) -> Vec<Capsule> {
        match self {
            Self::Splash { seed } => splash(seed),
            Self::Uniform | Self::Brush { .. } => Vec::new(),
        }
    }
}

fn splash(seed: u32) -> Vec<Capsule> {
    let mut draws = (0..).map(|index| f64::from(hash(seed ^ hash(index)) >> 8) / f64::from(1 << 24));
    let mut between = |low: f64, high: f64| low + (high - low) * draws.next().unwrap_or_default();
    let at = |radius: f64, angle: f64| [radius * angle.cos(), radius * angle.sin()];
    let mut shapes = Vec::new();
    for _ in 0..5 {
        let centre = at(between(0.0, 0.11), between(0.0, TAU));
        let radius = between(0.06, 0.11);
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
    for _ in 0..36 {
        let (reach, angle) = (between(0.22, 0.42), between(0.0, TAU));
        let radius = 0.003 + 0.016 * between(0.0, 1.0).powi(3);
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
