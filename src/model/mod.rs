//! Physics and settings as plain types and f64 functions. No wgpu.

mod boundary;
pub mod color;
mod fourier;
mod lafortune;
mod settings;

pub use boundary::Boundary;
pub use fourier::Fourier;
pub use lafortune::lafortune;
pub use settings::{FitSettings, SpecularScale};
