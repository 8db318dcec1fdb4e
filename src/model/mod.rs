//! Physics and settings as plain types and f64 functions. No wgpu.

mod boundary;
mod settings;

pub use boundary::Boundary;
pub use settings::{FitSettings, SpecularScale};
pub use super::pipeline::pending::paint::{Layer, Paint, PaintError, Pattern, linear_from_srgb, pigments};
