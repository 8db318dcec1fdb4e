//! Host side of the compute stages, one file each.

mod brdf_values;
mod error;
mod fft;
mod frankot_chellappa;
mod gather;
mod kubelka_munk;
mod lafortune_fit;
mod normals;
mod paint_relief;
mod pattern;
mod percentile;
mod photometric_stereo;
mod picture_error;
mod reconstruct;
mod scalar;
mod specular_residual;
mod specular_scale;
mod surface;
mod synth;
mod tile;

pub use brdf_values::BrdfValues;
pub use error::StageError;
pub use fft::Fft;
pub use frankot_chellappa::FrankotChellappa;
pub use gather::{Gather, Gathered};
pub use kubelka_munk::KubelkaMunk;
pub use lafortune_fit::{FittedLobes, LafortuneFit, STARTS};
pub use normals::Normals;
pub use paint_relief::PaintRelief;
pub use pattern::Pattern;
pub use percentile::Percentile;
pub use photometric_stereo::PhotometricStereo;
pub use picture_error::{Originals, PictureError, PictureSums};
pub use reconstruct::Reconstruct;
pub use specular_residual::SpecularResidual;
pub use specular_scale::SpecularScale;
pub use surface::{Scene, Surface};
pub use synth::{Rendered, Synth, SynthSurface};
pub use tile::Tile;

pub(crate) use scalar::{count, single};
