//! CPU twins of the stages in f64, from the papers, by another route than the kernels. Only tests and benches use them.

mod brdf_values;
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
mod plane;
mod reconstruct;
mod relief;
mod shade;
mod specular_residual;
mod specular_scale;
mod synth;

pub use brdf_values::brdf_values;
pub use fft::fft;
pub use frankot_chellappa::frankot_chellappa;
pub use gather::gather;
pub use kubelka_munk::{film, kubelka_munk};
pub use lafortune_fit::{LafortuneFit, lafortune_fit, lafortune_gradient, lafortune_objective};
pub use normals::normals;
pub use paint_relief::paint_relief;
pub use pattern::pattern;
pub use percentile::percentile;
pub use photometric_stereo::photometric_stereo;
pub use plane::plane;
pub use reconstruct::reconstruct;
pub use shade::Surface;
pub use specular_residual::specular_residual;
pub use specular_scale::specular_scale;
pub use synth::{SynthSurface, synth};
