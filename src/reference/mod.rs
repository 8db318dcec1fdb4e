//! CPU twins of the stages in f64, from the papers, by another route than the kernels. Only tests and benches use them.

mod fft;
mod frankot_chellappa;
mod normals;
mod photometric_stereo;

pub use fft::fft;
pub use frankot_chellappa::frankot_chellappa;
pub use normals::normals;
pub use photometric_stereo::photometric_stereo;
