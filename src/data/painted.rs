//! The paint on a material.

use super::Map;
use crate::model::{Layer, PaintMethod};

/// Paint on a material, as it is rendered.
#[derive(Debug, Clone, PartialEq)]
pub struct Painted {
    /// What it does to what lies below it.
    pub method: PaintMethod,
    /// The layers, from the bottom up.
    pub layers: Vec<Layer>,
    /// Names of the images that the layers' patterns name by their index.
    pub images: Vec<String>,
    /// Height of the painted surface, over the same plane as the material's own, in texel widths.
    pub height: Map<f32>,
    /// Unit normals of that surface.
    pub normal: Map<[f32; 3]>,
    /// Diffuse reflectance of the paint on the material's, R, G, B.
    pub reflectance: Map<[f32; 3]>,
    /// How much of the texel is painted, 0 to 1.
    pub coverage: Map<f32>,
    /// Reflectance F0 at normal incidence, and GGX width, of the topmost paint's surface.
    pub coat: Map<[f32; 2]>,
}

impl Painted {
    /// The paint of a material laid side by side with itself ([`Material::repeated`](super::Material::repeated)).
    #[must_use]
    pub fn repeated(&self, columns: usize, rows: usize) -> Self {
        Self {
            method: self.method,
            layers: self.layers.clone(),
            images: self.images.clone(),
            height: self.height.repeated(columns, rows),
            normal: self.normal.repeated(columns, rows),
            reflectance: self.reflectance.repeated(columns, rows),
            coverage: self.coverage.repeated(columns, rows),
            coat: self.coat.repeated(columns, rows),
        }
    }
}
