//! Host side of the compute stages, one file each.

mod error;
mod fft;
mod frankot_chellappa;
mod normals;
mod photometric_stereo;

pub use error::StageError;
pub use fft::Fft;
pub use frankot_chellappa::FrankotChellappa;
pub use normals::Normals;
pub use photometric_stereo::PhotometricStereo;
