//! Physics and settings as plain types and f64 functions. No wgpu.

mod boundary;
pub mod color;
mod settings;

pub use boundary::Boundary;
pub use settings::{FitSettings, SpecularScale};
