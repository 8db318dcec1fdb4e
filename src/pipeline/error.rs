//! Errors of a pipeline.

use crate::{
    data::{EnvironmentError, ShapeError},
    gpu::GpuError,
    io::IoError,
    model::{PaintError, PaintMethod, SettingsError, SynthError, pigments::PigmentError},
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
    /// A name that is no paint's.
    #[error(transparent)]
    Pigment(#[from] PigmentError),
    /// A synthetic material that cannot be rendered.
    #[error(transparent)]
    Synth(#[from] SynthError),
    /// An environment that is none.
    #[error(transparent)]
    Environment(#[from] EnvironmentError),
    /// No ffmpeg.
    #[error("films are made by ffmpeg, which cannot be run; install it, or name numbered pictures such as turn_###.png")]
    NoFfmpeg,
    /// ffmpeg failed.
    #[error("ffmpeg could not make {path}: {message}; the pictures stay, so that the same command goes on from them", path = path.display())]
    Ffmpeg {
        /// The film.
        path: std::path::PathBuf,
        /// What it says.
        message: String,
    },
    /// A stage refused its input.
    #[error(transparent)]
    Stage(#[from] StageError),
    /// A file could not be read or written.
    #[error(transparent)]
    Source(#[from] IoError),
    /// A map came back in another shape than it was asked for: a bug of this program.
    #[error(transparent)]
    Shape(#[from] ShapeError),
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
    /// A material of another plane than the source's.
    #[error(
        "\"{source_name}\" has {} x {} texels and the material {} x {}; compare a material with the source it was recovered from, and with \
         the same --region",
        source_size[0], source_size[1], material_size[0], material_size[1]
    )]
    SizesDiffer {
        /// Name of the source.
        source_name: String,
        /// Its columns and rows.
        source_size: [usize; 2],
        /// The material's.
        material_size: [usize; 2],
    },
    /// A local PCA that was left out.
    #[error("the material of \"{source_name}\" has no local PCA; fit it again without --no-lpca, or leave out --model lpca")]
    NoLpca {
        /// Name of the source.
        source_name: String,
    },
    /// A pattern of an image that there is not.
    #[error("a layer draws image {image}, but the recipe has {images}; add it to the recipe's images, or name another")]
    NoSuchImage {
        /// Its index.
        image: usize,
        /// Images there are.
        images: usize,
    },
    /// A plane that no adapter paints.
    #[error(
        "{} x {} pieces of {} x {} texels cannot be painted: a plane has at least 1 and on {adapter} at most {limit} texels; repeat the material less often",
        repeat[0], repeat[1], size[0], size[1]
    )]
    PlaneTooLarge {
        /// Columns and rows of the material.
        size: [usize; 2],
        /// Pieces to the right and downwards.
        repeat: [usize; 2],
        /// The adapter.
        adapter: String,
        /// Most texels of a plane.
        limit: usize,
    },
    /// A painted material where a bare one is needed.
    #[error("the material is painted; take the bare material that it was made from")]
    Painted,
    /// Paint over paint of another kind.
    #[error("the material is already painted by {before}, which cannot go on by {asked}; paint the bare material")]
    MethodsDiffer {
        /// What is there.
        before: PaintMethod,
        /// What was asked for.
        asked: PaintMethod,
    },
    /// A texel outside the plane.
    #[error("there is no texel {column},{row}: the plane has columns 0 to {} and rows 0 to {}; name one of them", width - 1, height - 1)]
    NoSuchTexel {
        /// Its column.
        column: usize,
        /// Its row.
        row: usize,
        /// Columns there are.
        width: usize,
        /// Rows there are.
        height: usize,
    },
    /// A local PCA whose terms no renderer on this adapter could bind.
    #[error(
        "a local PCA of {samples} samples with {clusters} clusters and {components} components has terms of {bytes} bytes, but {adapter} binds no more \
         than {limit}; take fewer --clusters or --components"
    )]
    LpcaTooLarge {
        /// Clusters asked for.
        clusters: usize,
        /// Components asked for.
        components: usize,
        /// Samples of the source.
        samples: usize,
        /// Bytes of the terms.
        bytes: u64,
        /// The adapter.
        adapter: String,
        /// Bytes that it binds.
        limit: u64,
    },
    /// No local PCA is as small as was asked for.
    #[error(
        "no local PCA of this source is as small as asked for, or fits the adapter: the smallest takes {least} bytes; allow at least that"
    )]
    LpcaTarget {
        /// Bytes of the smallest.
        least: u64,
    },
    /// A plot that could not be drawn.
    #[error("the plot could not be drawn: {message}; the figures themselves are in compare.json")]
    Plot {
        /// What the library says.
        message: String,
    },
}
