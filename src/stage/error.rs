//! Errors of the stages.

use crate::gpu::GpuError;

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
}
