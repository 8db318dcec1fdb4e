//! What is painted: layers from the bottom up.

use super::Map;
use crate::model::Layer;

/// Layers of paint and what they are laid on.
#[derive(Debug, Clone, PartialEq)]
pub struct Recipe {
    /// How many times the material lies side by side below the paint, to the right and downwards.
    pub repeat: [usize; 2],
    /// The layers, from the bottom up.
    pub layers: Vec<Layer>,
    /// The images that patterns name by their index.
    pub images: Vec<PatternImage>,
}

/// An image that a pattern draws.
#[derive(Debug, Clone, PartialEq)]
pub struct PatternImage {
    /// Its name as the recipe has it.
    pub name: String,
    /// Drawn thickness, 0 (black, bare) to 1 (white).
    pub drawn: Map<f32>,
}

impl Recipe {
    /// One layer on one piece of the material.
    #[must_use]
    pub fn of(layer: Layer) -> Self {
        Self { repeat: [1, 1], layers: vec![layer], images: Vec::new() }
    }
}
