//! Host side of the compute stages, one file each.

mod brdf_values;
mod lafortune_fit;
mod normals;
mod percentile;
mod specular_residual;
mod specular_scale;
mod srgb_decode;
mod tile;

pub use brdf_values::BrdfValues;
pub use lafortune_fit::{FittedLobes, LafortuneFit, STARTS};
pub use normals::Normals;
pub use percentile::Percentile;
pub use specular_residual::SpecularResidual;
pub use specular_scale::SpecularScale;
pub use srgb_decode::SrgbDecode;
pub use tile::Tile;
