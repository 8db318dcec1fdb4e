//! Host side of the render passes, one file each.

mod plane;

pub use plane::Plane;
