//! Placements: where on a plane a pattern is drawn.

use super::PatternError;

/// Where a pattern is drawn. The plane is divided into equal cells, all drawn alike; a cell's coordinates have their origin in its
/// middle, x right, y up, its shorter edge 1 long. In each the pattern is scaled by `size`, then turned by `rotation`, then moved by
/// `offset`; what passes a cell's edge enters at the opposite one, so that the plane repeats without seams. Where a pattern meets
/// itself in this way, the thicker paint shows.
///
/// Patterns that fill their cell can close at its edges only as whole repetitions: of stripes, the whole number along each edge is
/// drawn that is nearest to size and rotation ([`Self::wave`]); the lattices of noise and spatter have the whole number of points
/// nearest to the size ([`Self::lattice`]) and are not turned: rotation leaves noise as it is, and turns a spatter's drops about
/// their middles.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Placement {
    /// Columns and rows of cells, 1 to 1000.
    pub tiling: [u32; 2],
    /// Right and up, in the cell's coordinates.
    pub offset: [f64; 2],
    /// Counter-clockwise, radians.
    pub rotation: f64,
    /// Factor on the pattern's lengths, 0.001 to 4: what is larger meets itself too often to be recognised.
    pub size: f64,
}

impl Default for Placement {
    /// One cell, the pattern in its middle at its own size.
    fn default() -> Self {
        Self { tiling: [1, 1], offset: [0.0, 0.0], rotation: 0.0, size: 1.0 }
    }
}

/// Most lattice points or stripes along an edge: more than any plane has texels, and f32 still counts them.
const MAX_PERIODS: f64 = 1_048_576.0;

impl Placement {
    /// The placement itself, if its settings are in range.
    ///
    /// # Errors
    /// [`PatternError`] for the first that is not.
    pub fn checked(self) -> Result<Self, PatternError> {
        let refused = |setting, found, expected| Err(PatternError { of: "a placement", setting, found, expected });
        let finite = "a finite number";
        match self {
            Self { tiling: [count, _] | [_, count], .. } if !(1..=1000).contains(&count) => {
                refused("tiling", count.into(), "at least 1 and at most 1000 cells either way")
            }
            Self { offset: [distance, _] | [_, distance], .. } if !distance.is_finite() => refused("offset", distance, finite),
            Self { rotation, .. } if !rotation.is_finite() => refused("rotation", rotation, finite),
            Self { size, .. } if !(0.001..=4.0).contains(&size) => refused("size", size, "at least 0.001 and at most 4"),
            _ => Ok(self),
        }
    }

    /// Columns and rows of texels that a cell has on a plane of `size` texels; they need not be whole.
    #[must_use]
    pub fn cell(self, size: [u32; 2]) -> [f64; 2] {
        [0, 1].map(|axis| f64::from(size[axis]) / f64::from(self.tiling[axis]))
    }

    /// Lengths of a cell's edges in its own coordinates: the shorter one is 1.
    #[must_use]
    pub fn edges(self, size: [u32; 2]) -> [f64; 2] {
        let [width, height] = self.cell(size);
        [width, height].map(|edge| edge / width.min(height))
    }

    /// Cosine and sine of the rotation, exact where it is a whole number of quarter turns to nine digits.
    #[must_use]
    pub fn turn(self) -> [f64; 2] {
        let turn = [self.rotation.cos(), self.rotation.sin()];
        if turn.iter().any(|part| part.abs() < 1e-9) { turn.map(f64::round) } else { turn }
    }

    /// Points of a lattice along the edges of a cell, `count` of which would lie along the shorter edge at size 1: the nearest whole
    /// numbers, at least 1.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number between 1 and 2^20")]
    pub fn lattice(self, count: u32, size: [u32; 2]) -> [u32; 2] {
        self.edges(size).map(|edge| (f64::from(count) * edge / self.size).round().clamp(1.0, MAX_PERIODS) as u32)
    }

    /// Whole numbers of stripes that are crossed along the edges of a cell, right and up: those nearest to `count` from left to
    /// right, scaled and turned, and one if that would be none.
    #[must_use]
    pub fn wave(self, count: u32, size: [u32; 2]) -> [f64; 2] {
        let ([cosine, sine], [width, height]) = (self.turn(), self.edges(size));
        let count = f64::from(count) / self.size;
        let asked = [-sine * count * width, cosine * count * height];
        let wave = asked.map(|periods| periods.round().clamp(-MAX_PERIODS, MAX_PERIODS));
        if wave != [0.0, 0.0] {
            wave
        } else if asked[0].abs() > asked[1].abs() {
            [asked[0].signum(), 0.0]
        } else {
            [0.0, 1.0]
        }
    }
}
