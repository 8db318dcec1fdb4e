//! What the height field does to a picture.
//!
//! A place that sees a share of the light shows that share of its radiance, and one that sees none is black: what other texels
//! throw into a shadow is part of the measured reflectance, which does not tell it from what the light itself sends.

/// Which effects of the height field a picture has.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Relief {
    /// Whether height moves texels and hides those behind it. Otherwise each ray sees its place on the base plane.
    pub displace: bool,
    /// Whether the height field casts shadows on itself.
    pub shadow: bool,
    /// Tangent of the light's angular width, by which shadows are softened; above zero.
    pub penumbra: f64,
}

impl Relief {
    /// Everything on, under the light of a measurement: a measuring lamp is small and far away, that of a path-traced set a
    /// point at infinity. 0.2°, so that an edge is sharp within a texel behind a relief of many.
    #[must_use]
    pub fn measured() -> Self {
        Self { penumbra: 0.004, ..Self::default() }
    }
}

impl Default for Relief {
    /// Everything on, under a lamp of 6°.
    fn default() -> Self {
        Self { displace: true, shadow: true, penumbra: 0.1 }
    }
}
