//! Host side of the compute stages, one file each.

mod normals;

pub use normals::Normals;
