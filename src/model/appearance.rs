//! Which part of a material pictures are made from.

use super::{Relief, TexelSamples};

/// Which part of a material pictures are made from, and how.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[serde(tag = "model", rename_all = "lowercase")]
pub enum Appearance {
    /// Its reflectance on its height field: what is painted.
    Svbrdf {
        /// Which effects of the height field they have.
        relief: Relief,
    },
    /// Its local PCA: the original's full look, with the parallax and shadows that were measured.
    Lpca {
        /// How they are interpolated between texels.
        texel_samples: TexelSamples,
    },
}

impl Appearance {
    /// The reflectance as a measurement would show it.
    #[must_use]
    pub fn svbrdf() -> Self {
        Self::Svbrdf { relief: Relief::measured() }
    }
}
