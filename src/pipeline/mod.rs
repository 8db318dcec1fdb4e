//! Chains stages: owns buffers, cuts a source into tiles, submits, and reports progress.

mod compare;
mod demo;
mod error;
mod export;
mod figures;
mod figures_on_meshes;
mod fit;
mod geometry;
mod import;
mod lpca;
mod measured;
mod memory;
mod paint;
mod progress;
mod reflectance;
mod renderer;
mod report;
mod studio;
mod swatches;
mod synth;
mod tiles;
mod turntable;

pub use compare::{
    AtElevation, AtElevations, CompareSettings, Comparison, PairQuality, Quality, TexelError, check_comparison, compare, compare_into,
};
pub use demo::{REPORT, demo};
pub use error::PipelineError;
pub use export::export_tree;
pub use figures::{FIGURES, FigureSettings, Pictured, figures};
pub use fit::{check_fit, fit, fit_job, fit_within};
pub use import::{Imported, import};
pub use lpca::lpca;
pub use memory::Memory;
pub use paint::Painter;
pub use progress::{Observer, Progress, StageGuard, StageTable, StageTime};
pub use renderer::{Dressed, Renderer};
pub use studio::{Studio, Subject};
pub use swatches::swatches;
pub use synth::Synthetic;
pub use turntable::{check_ffmpeg, encode, frame, frames, numbered};
