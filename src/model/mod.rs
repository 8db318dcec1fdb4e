//! Physics and settings as plain types and f64 functions. No wgpu.

mod boundary;
mod fourier;
mod settings;

pub use boundary::Boundary;
pub use fourier::Fourier;
pub use settings::{FitSettings, SpecularScale};
