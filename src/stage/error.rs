//! Errors of the stages.

use crate::{data::BtfError, gpu::GpuError};

/// What can keep a stage from being recorded.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StageError {
    /// The GPU layer's own.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// Too few lights for a normal.
    #[error(
        "photometric stereo needs at least 3 lights, but the view nearest the zenith has {found}. Use a source with more lights in that view"
    )]
    TooFewLights {
        /// Lights given.
        found: usize,
    },
    /// Lights that leave a direction of the normal undetermined.
    #[error(
        "photometric stereo needs lights around the surface, but the {found} lights of the view nearest the zenith are one \
         direction or lie within {within:.2} degrees of a plane through the surface's point. Add lights at other azimuths"
    )]
    CoplanarLights {
        /// Lights given.
        found: usize,
        /// Their typical angle to the plane that fits them best, in degrees.
        within: f64,
    },
    /// Samples of a compressed BTF that refer to no direction.
    #[error(transparent)]
    Pairs(#[from] BtfError),
    /// Terms of a local PCA that exceed one array.
    #[error(
        "the terms of the local PCA need {bytes} bytes, but adapter \"{adapter}\" allows {limit} in an array. Fit fewer --clusters or \
         --components, or use an adapter with larger limits (`overpaint adapters` lists them)"
    )]
    LpcaTooLarge {
        /// Bytes of the terms.
        bytes: u64,
        /// The adapter's name.
        adapter: String,
        /// Bytes that an array may have.
        limit: u64,
    },
    /// Views and lights whose pairs exceed one array.
    #[error(
        "a table of {views} views by {lights} lights needs {bytes} bytes, but adapter \"{adapter}\" allows {limit} in an array. Fit with \
         --every to take fewer of them, or use an adapter with larger limits (`overpaint adapters` lists them)"
    )]
    TooManyDirections {
        /// Number of views.
        views: usize,
        /// Number of lights.
        lights: usize,
        /// Bytes of the table.
        bytes: u64,
        /// The adapter's name.
        adapter: String,
        /// Bytes that an array may have.
        limit: u64,
    },
}
