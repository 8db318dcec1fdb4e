//! Physics and settings as plain types and f64 functions. No wgpu.

mod appearance;
mod boundary;
mod coat;
pub mod color;
mod environment;
mod fourier;
mod frame;
pub mod kubelka_munk;
mod lafortune;
mod lpca;
pub mod metallic_roughness;
pub mod microfacet;
mod paint;
pub mod pattern;
pub mod pigments;
mod placement;
mod relief;
mod settings;
pub mod spectrum;
pub mod stereo;
mod synth;
mod texel_samples;
mod tone;

pub use appearance::Appearance;
pub use boundary::Boundary;
pub use coat::Coat;
pub use environment::{
    ALBEDO_SIZE, ENVIRONMENT_LEVELS, ENVIRONMENT_SIZE, ENVIRONMENT_SOURCE, albedo_node, environment_level, environment_roughness,
};
pub use fourier::Fourier;
pub use frame::{Frame, in_frame, product_in_frame};
pub use kubelka_munk::Film;
pub use lafortune::{MAX_LOBES, MIN_LOBE_ENERGY, MIN_LOBE_SAMPLES, lafortune, lafortune_albedo};
pub use lpca::{LpcaMethod, LpcaSettings, LpcaTarget, MAX_CLUSTERS, MAX_COMPONENTS, MAX_RANK, Weighting};
pub use metallic_roughness::MetallicRoughness;
pub use paint::{Layer, Paint, PaintError, PaintMethod};
pub use pattern::{Capsule, Pattern, PatternError};
pub use pigments::Pigment;
pub use placement::Placement;
pub use relief::Relief;
pub use settings::{FitSettings, SettingsError, SpecularScale, StereoMethod, SurfaceMode};
pub use synth::{HeightField, Synth, SynthError, SynthPlace, SynthReflectance, SynthTexel};
pub use texel_samples::TexelSamples;
pub use tone::{Development, ToneMap, on_white};
