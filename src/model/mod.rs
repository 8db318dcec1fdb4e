//! Physics and settings as plain types and f64 functions. No wgpu.

mod boundary;
pub mod kubelka_munk;
pub mod microfacet;
mod paint;
pub mod pattern;
pub mod pigments;
mod settings;

pub use boundary::Boundary;
pub use kubelka_munk::Film;
pub use paint::{Layer, Paint, PaintError};
pub use pattern::{Capsule, Pattern, PatternError};
pub use pigments::Pigment;
pub use settings::{FitSettings, SpecularScale};
