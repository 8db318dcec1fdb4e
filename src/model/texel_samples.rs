//! How many texels of a compressed BTF a place between them is interpolated from.

/// Texels that a picture of a compressed BTF is interpolated from at each place: B-splines, the same in rows and columns, that sum to 1.
///
/// Texels are not filtered before they are decompressed: two clusters have nothing in common that could be averaged. So each costs as much as
/// all of a nearest-texel picture, and the number is for the user to choose.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize)]
#[serde(into = "u32")]
pub enum TexelSamples {
    /// The nearest: blocks where texels are large.
    One,
    /// Bilinear: the linear B-spline.
    #[default]
    Four,
    /// The quadratic B-spline without its four corners, made to sum to 1 again: softer than bilinear next to a texel's centre; where four
    /// texels meet, one of them comes and another goes, with a third of the weight.
    Five,
    /// The quadratic B-spline, whose slope is continuous.
    Nine,
    /// The quartic B-spline, whose third derivative is continuous.
    TwentyFive,
}

impl TexelSamples {
    /// All, fewest first.
    pub const ALL: [Self; 5] = [Self::One, Self::Four, Self::Five, Self::Nine, Self::TwentyFive];

    /// Number of texels: the code that kernels know it by (`kernels/common/texel_filter.wgsl`).
    #[must_use]
    pub fn count(self) -> u32 {
        match self {
            Self::One => 1,
            Self::Four => 4,
            Self::Five => 5,
            Self::Nine => 9,
            Self::TwentyFive => 25,
        }
    }
}

impl From<TexelSamples> for u32 {
    fn from(samples: TexelSamples) -> Self {
        samples.count()
    }
}
