//! How a picture of a material is taken.

use super::Direction;

/// A picture of the material as a plane: orthographic, under one directional light.
///
/// The picture's up is the material's +y as seen from `view` (right is +y × view), its centre the plane's centre. The plane
/// is as large as fits, less the margin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaneView {
    /// Towards the camera.
    pub view: Direction,
    /// Towards the light.
    pub light: Direction,
    /// Columns and rows of the picture.
    pub size: [u32; 2],
    /// Part of the picture's width and height kept free around the plane, 0 to 1 (exclusive), both sides together.
    pub margin: f64,
    /// Rays a pixel along each axis, so `samples`² in all; at least one is cast.
    pub samples: u32,
}

impl PlaneView {
    /// A picture with a small margin and four rays a pixel.
    #[must_use]
    pub fn new(view: Direction, light: Direction, size: [u32; 2]) -> Self {
        Self { view, light, size, margin: 0.04, samples: 2 }
    }
}
