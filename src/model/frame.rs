//! The frame that a texel's reflectance is in.

use glam::{DQuat, DVec3};

/// Which normal the unpainted reflectance takes its cosine and its lobes' axes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Frame {
    /// The base plane's: the surface is taken as flat, and what it does to light and view is left to the lobes.
    #[default]
    Plane,
    /// The texel's own, from the height field; what the surface hides and shadows is left to the lobes.
    Texel,
    /// That of the point of the height field which the view sees at the texel's place, in the share of the light that reaches it.
    Seen,
}

impl Frame {
    /// The code that kernels know it by (`kernels/common/shade.wgsl`).
    #[must_use]
    pub fn code(self) -> u32 {
        match self {
            Self::Plane => 0,
            Self::Texel => 1,
            Self::Seen => 2,
        }
    }
}

/// The components of `direction` in the frame of unit `normal`: the base plane's turned by the shortest way from z to the normal.
#[must_use]
pub fn in_frame(normal: DVec3, direction: DVec3) -> DVec3 {
    DQuat::from_rotation_arc(normal, DVec3::Z) * direction
}

/// ω_i ω_o by components in the frame of unit `normal`.
#[must_use]
pub fn product_in_frame(normal: DVec3, view: DVec3, light: DVec3) -> [f64; 3] {
    (in_frame(normal, view) * in_frame(normal, light)).to_array()
}
