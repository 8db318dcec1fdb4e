//! Physics and settings as plain types and f64 functions. No wgpu.

mod boundary;
mod coat;
mod relief;
mod settings;

pub use boundary::Boundary;
pub use coat::Coat;
pub use relief::Relief;
pub use settings::{FitSettings, SpecularScale};
