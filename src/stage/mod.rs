//! Host side of the compute stages, one file each.

mod normals;
mod reconstruct;
mod surface;

pub use normals::Normals;
pub use reconstruct::Reconstruct;
pub use surface::{Scene, Surface};
