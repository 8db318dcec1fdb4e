//! Host side of the render passes, one file each.

mod lighting;
mod mesh;
mod plane;
mod surroundings;

pub use lighting::{Lighting, Lights, ShadowPass};
pub use mesh::{MeshBuffers, MeshPass, MeshTarget, Output, Shown};
pub use plane::Plane;
pub use surroundings::SurroundingsBuffers;
