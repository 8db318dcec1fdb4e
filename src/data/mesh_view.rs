//! A mesh that wears a material, and how it is looked at.

use super::{Camera, Light, Mesh};
use crate::model::{Relief, TexelSamples};

/// What pictures of a mesh are of, and how they are taken; the material comes beside.
#[derive(Debug, Clone)]
pub struct MeshView {
    /// The mesh.
    pub mesh: Mesh,
    /// Pieces of the material per unit of texture coordinates, across and up.
    pub tiling: [f64; 2],
    /// Where it is seen from.
    pub camera: Camera,
    /// What shines on it.
    pub lights: Vec<Light>,
    /// Whether it throws shadows on itself.
    pub shadows: bool,
    /// What the bare part is made from: its local PCA, interpolated so, or its reflectance.
    pub unpainted: Option<TexelSamples>,
    /// Which effects of the height field the picture has.
    pub relief: Relief,
    /// Whether rays that leave the sheet of texture coordinates 0 to 1 see through it.
    pub silhouette: bool,
    /// How densely the picture samples the material.
    pub sampling: Sampling,
}

/// How densely a picture samples the material.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sampling {
    /// Rays across a pixel, and down it, at most: where it covers several texels it has as many, up to this.
    pub rays: u32,
    /// Pictures that the pixels of the final one are means of, each moved by a part of a pixel.
    pub pictures: u32,
}

impl Default for Sampling {
    /// One picture, two rays each way.
    fn default() -> Self {
        Self { rays: 2, pictures: 1 }
    }
}

impl MeshView {
    /// `mesh` seen by `camera` under `lights`: one piece of the material per unit of texture coordinates, with shadows, relief, and the bare
    /// part made from its reflectance.
    #[must_use]
    pub fn new(mesh: Mesh, camera: Camera, lights: Vec<Light>) -> Self {
        Self {
            mesh,
            tiling: [1.0; 2],
            camera,
            lights,
            shadows: true,
            unpainted: None,
            relief: Relief::default(),
            silhouette: false,
            sampling: Sampling::default(),
        }
    }
}
