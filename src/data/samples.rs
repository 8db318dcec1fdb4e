//! The directions of a tile's samples, as stages need them.

use super::Direction;

/// Samples in an octet, the unit in which they are stored on the GPU.
pub const OCTET: usize = 8;

/// (view, light) of each sample of a tile, in the order of its octets.
#[derive(Debug, Clone, PartialEq)]
pub struct Samples {
    directions: Vec<(Direction, Direction)>,
}

impl Samples {
    /// The samples with the given (view, light) directions.
    #[must_use]
    pub fn new(directions: Vec<(Direction, Direction)>) -> Self {
        Self { directions }
    }

    /// Number of samples.
    #[must_use]
    pub fn len(&self) -> usize {
        self.directions.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.directions.is_empty()
    }

    /// Number of octets: the last is filled up with zeros.
    #[must_use]
    pub fn octets(&self) -> usize {
        self.directions.len().div_ceil(OCTET)
    }

    /// (view, light) of each sample.
    #[must_use]
    pub fn directions(&self) -> &[(Direction, Direction)] {
        &self.directions
    }

    /// cos θ_i of each sample.
    pub fn light_cosines(&self) -> impl Iterator<Item = f64> {
        self.directions.iter().map(|(_, light)| light.theta.cos())
    }

    /// ω_i ω_o by components, of each sample: what a Lafortune lobe is a function of.
    pub fn products(&self) -> impl Iterator<Item = [f64; 3]> {
        self.directions.iter().map(|(view, light)| (view.vector() * light.vector()).to_array())
    }
}
