//! Materials to be rendered: a height field that repeats and the reflectance of every texel, both from seeded patterns.
//!
//! Patterns live on the unit square that the texel plane covers (x right, y up) and repeat with it; they have a number of features along
//! an edge, not a size in texels, so that the same material is made at any resolution. Heights are the pattern's 0 to 1 times the relief.

mod height_field;
mod noise;
mod reflectance;

pub use height_field::HeightField;
pub use reflectance::{SynthReflectance, SynthTexel};

/// A material to be rendered.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Synth {
    /// Shape of the surface.
    pub height_field: HeightField,
    /// Height of the pattern's highest place over its lowest, in texel widths.
    pub relief: f64,
    /// What the surface is made of.
    pub reflectance: SynthReflectance,
    /// Another number, another material of the kind.
    pub seed: u32,
}

/// A relief that cannot be rendered.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("the relief is {found} texel widths; it must be from 0 to {limit}", limit = Synth::MAX_RELIEF)]
pub struct SynthError {
    /// The relief.
    pub found: f64,
}

/// A place of a texel plane: where on the unit square, and how long the plane's edges are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SynthPlace {
    /// (x, y) in 0..1, x right, y up.
    pub at: [f64; 2],
    /// Lengths of the plane's edges; the shorter is 1.
    pub edges: [f64; 2],
}

impl SynthPlace {
    /// The centre of texel (`column`, `row`) of a plane of `size` columns and rows, row 0 at the top.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "columns and rows of a plane")]
    pub fn texel(size: [usize; 2], column: usize, row: usize) -> Self {
        let [width, height] = size.map(|side| side as f64);
        let shorter = width.min(height);
        Self { at: [(column as f64 + 0.5) / width, 1.0 - (row as f64 + 0.5) / height], edges: [width / shorter, height / shorter] }
    }

    /// The place counted in cells of a lattice of about `per_edge` cells along the shorter edge that closes at the plane's edges, and the
    /// lattice's cells along each edge: multiples of `multiple`.
    fn cells(&self, per_edge: f64, multiple: f64) -> ([f64; 2], [f64; 2]) {
        let count = self.edges.map(|edge| (per_edge * edge / multiple).round().max(1.0) * multiple);
        ([self.at[0] * count[0], self.at[1] * count[1]], count)
    }
}

impl Synth {
    /// The largest relief in texel widths: what a ray of 85° passes over within 5000 texels.
    pub const MAX_RELIEF: f64 = 256.0;

    /// The material itself, if its relief is in range.
    ///
    /// # Errors
    /// [`SynthError`] if it is not.
    pub fn checked(self) -> Result<Self, SynthError> {
        if (0.0..=Self::MAX_RELIEF).contains(&self.relief) { Ok(self) } else { Err(SynthError { found: self.relief }) }
    }

    /// Height at a place in texel widths, 0 to the relief.
    #[must_use]
    pub fn height(&self, place: SynthPlace) -> f64 {
        self.relief * self.height_field.height(place, self.seed)
    }

    /// Reflectance at a place.
    #[must_use]
    pub fn texel(&self, place: SynthPlace) -> SynthTexel {
        self.reflectance.texel(place, self.seed)
    }
}

impl std::fmt::Display for Synth {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { height_field, relief, reflectance, seed } = self;
        write!(out, "{reflectance} {height_field}, relief {relief} texels, seed {seed}")
    }
}
