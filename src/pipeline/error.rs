//! Errors of a pipeline.

use crate::{
    data::ShapeError,
    gpu::GpuError,
    io::IoError,
    model::{PaintError, PatternError, SettingsError, SynthError},
    stage::StageError,
};

/// What can go wrong while stages are chained.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PipelineError {
    /// An adapter's error.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// A setting that no stage can work with.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// A layer of paint that no stage can work with.
    #[error(transparent)]
    Paint(#[from] PaintError),
    /// A pattern that no stage can work with.
    #[error(transparent)]
    Pattern(#[from] PatternError),
    /// A synthetic material that cannot be rendered.
    #[error(transparent)]
    Synth(#[from] SynthError),
    /// A stage refused its input.
    #[error(transparent)]
    Stage(#[from] StageError),
    /// A file could not be read or written.
    #[error(transparent)]
    Source(#[from] IoError),
    /// A map came back in another shape than it was asked for: a bug of this program.
    #[error(transparent)]
    Shape(#[from] ShapeError),
    /// A texel was named that is not there.
    #[error(
        "the plane has {width} x {height} texels; there is no texel {column},{row}. Name a column from 0 and a row from 0, the top row"
    )]
    NoSuchTexel {
        /// Named column.
        column: usize,
        /// Named row.
        row: usize,
        /// Columns that there are.
        width: usize,
        /// Rows that there are.
        height: usize,
    },
    /// Every light is too low for the reflectance to be computed.
    #[error(
        "all {samples} samples of \"{source_name}\" have lights lower than cos θ = {min_cos_light}, so that no reflectance can be computed. Lower min_cos_light"
    )]
    OnlyGrazingLights {
        /// Name of the source.
        source_name: String,
        /// Its samples.
        samples: usize,
        /// The bound that all of them miss.
        min_cos_light: f64,
    },
}
