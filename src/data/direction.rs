//! Directions over the texel plane.

use glam::DVec3;

/// A unit direction that points away from the surface: θ from the normal, φ counter-clockwise from +x. Radians.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Direction {
    /// Angle to the normal of the texel plane, in radians.
    pub theta: f64,
    /// Azimuth, counter-clockwise from +x (right) seen from above, in radians.
    pub phi: f64,
}

impl Direction {
    /// From angles in degrees.
    #[must_use]
    pub fn from_degrees(theta: f64, phi: f64) -> Self {
        Self { theta: theta.to_radians(), phi: phi.to_radians() }
    }

    /// Of a vector of any length other than 0: φ from 0 to below 2π, 0 at the zenith.
    #[must_use]
    pub fn from_vector(vector: DVec3) -> Self {
        let phi = vector.y.atan2(vector.x);
        let turned = if phi < 0.0 { phi + std::f64::consts::TAU } else { phi };
        // A negative angle next to 0 rounds up to the full turn; both zeros and all signs of 0 at the zenith are 0.
        let phi = if turned >= std::f64::consts::TAU || (vector.x == 0.0 && vector.y == 0.0) { 0.0 } else { turned + 0.0 };
        Self { theta: vector.x.hypot(vector.y).atan2(vector.z), phi }
    }

    /// The direction a `part` of the way from here to `end`, both angles changing evenly.
    #[must_use]
    pub fn toward(self, end: Self, part: f64) -> Self {
        let between = |start: f64, end: f64| start + part * (end - start);
        Self { theta: between(self.theta, end.theta), phi: between(self.phi, end.phi) }
    }

    /// (θ, φ) in degrees.
    #[must_use]
    pub fn degrees(self) -> (f64, f64) {
        (self.theta.to_degrees(), self.phi.to_degrees())
    }

    /// The unit vector: x right, y up, z out of the plane.
    #[must_use]
    pub fn vector(self) -> DVec3 {
        let ((sin_theta, cos_theta), (sin_phi, cos_phi)) = (self.theta.sin_cos(), self.phi.sin_cos());
        DVec3::new(sin_theta * cos_phi, sin_theta * sin_phi, cos_theta)
    }
}

impl std::fmt::Display for Direction {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (theta, phi) = self.degrees();
        write!(out, "θ {} φ {}", round(theta), round(phi))
    }
}

/// Degrees to a hundredth, without trailing zeros.
fn round(degrees: f64) -> f64 {
    (degrees * 100.0).round() / 100.0
}
