//! What the height field does to a picture.

/// Which effects of the height field a picture has.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Relief {
    /// Whether height moves texels and hides those behind it. Otherwise each ray sees its place on the base plane.
    pub displace: bool,
    /// Whether the height field casts shadows on itself: hard ones where unpainted, soft ones where painted.
    pub shadow: bool,
    /// Tangent of the light's angular width, by which shadows on paint are softened; above zero.
    pub penumbra: f64,
}

impl Default for Relief {
    /// Everything on, and a lamp of 6°.
    fn default() -> Self {
        Self { displace: true, shadow: true, penumbra: 0.1 }
    }
}
