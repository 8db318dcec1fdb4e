//! Host side of the render passes, one file each.

mod lighting;
mod mesh;
mod plane;

pub use lighting::{Lighting, Lights, ShadowPass};
pub use mesh::{MeshBuffers, MeshPass, Output, Worn};
pub use plane::Plane;
