//! Host side of the render passes, one file each.

mod mesh;
mod plane;

pub use mesh::{MeshBuffers, MeshPass, Output, Worn};
pub use plane::Plane;
