//! How a texel plane goes on beyond its edge.

/// What stands beyond the edge of a texel plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Boundary {
    /// The plane repeats: right for tileable samples, and what Frankot and Chellappa assume.
    #[default]
    Periodic,
    /// The plane is mirrored at its edge, the edge texel doubled: right for a cut-out of something larger.
    Mirror,
}

impl Boundary {
    /// The code that kernels know it by (`kernels/common/boundary.wgsl`).
    #[must_use]
    pub fn code(self) -> u32 {
        match self {
            Self::Periodic => 0,
            Self::Mirror => 1,
        }
    }

    /// The texel of `0..count` that stands for `index`.
    #[must_use]
    pub fn wrap(self, index: isize, count: usize) -> usize {
        let count = count.cast_signed();
        let wrapped = match self {
            Self::Periodic => index.rem_euclid(count),
            Self::Mirror => {
                let folded = index.rem_euclid(2 * count);
                folded.min(2 * count - 1 - folded)
            }
        };
        wrapped.cast_unsigned()
    }
}
