//! A mesh that wears a material, and how it is looked at.

use std::sync::Arc;

use glam::{DQuat, DVec3};

use super::{Camera, Environment, Light, Mesh};
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
    /// What is around it.
    pub surroundings: Option<Surroundings>,
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

/// An environment around a mesh.
#[derive(Debug, Clone)]
pub struct Surroundings {
    /// It.
    pub environment: Arc<Environment>,
    /// Factor on its light.
    pub strength: f64,
    /// By how much it has turned about the vertical axis, radians, its front to the right.
    pub turn: f64,
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
    /// Azimuth and elevation, degrees, that a mesh is seen from where nothing else is said.
    pub const BEARING: [f64; 2] = [30.0, 20.0];
    /// Degrees between the upper and the lower edge of a picture where nothing else is said.
    pub const ANGLE_OF_VIEW: f64 = 30.0;

    /// `mesh` seen by `camera` under `lights`: one piece of the material per unit of texture coordinates, with shadows, relief, and the bare
    /// part made from its reflectance.
    #[must_use]
    pub fn new(mesh: Mesh, camera: Camera, lights: Vec<Light>) -> Self {
        Self {
            mesh,
            tiling: [1.0; 2],
            camera,
            lights,
            surroundings: None,
            shadows: true,
            unpainted: None,
            relief: Relief::default(),
            silhouette: false,
            sampling: Sampling::default(),
        }
    }

    /// As if the mesh had turned by `angle`, radians, about the vertical axis through its middle, its front to the right: camera and lights
    /// have gone around it the other way.
    #[must_use]
    pub fn turned(&self, angle: f64) -> Self {
        let (center, _) = self.mesh.ball();
        let turn = DQuat::from_rotation_y(-angle);
        let about = |place: DVec3| center + turn * (place - center);
        let light = |light: &Light| match *light {
            Light::Directional { toward, irradiance } => Light::Directional { toward: turn * toward, irradiance },
            Light::Point { place, irradiance } => Light::Point { place: about(place), irradiance },
        };
        let Camera { eye, target, up, .. } = self.camera;
        Self {
            camera: Camera { eye: about(eye), target: about(target), up: turn * up, ..self.camera },
            lights: self.lights.iter().map(light).collect(),
            surroundings: self.surroundings.clone().map(|around| Surroundings { turn: around.turn - angle, ..around }),
            ..self.clone()
        }
    }
}

/// What a picture can tell beside its colours, of the middle of each pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Channel {
    /// Distance from the eye's plane, in units of the mesh; of parallel rays from the plane through the origin.
    Depth,
    /// Unit normal of the surface met, in the world.
    Normal,
    /// Coverage of paint, 0 to 1.
    Painted,
    /// Height of the paint over what it lies on, in texel widths.
    Thickness,
    /// Column and row of the texel met.
    Texel,
}

impl Channel {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Depth, Self::Normal, Self::Painted, Self::Thickness, Self::Texel];

    /// Its name on the command line and in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Depth => "depth",
            Self::Normal => "normal",
            Self::Painted => "painted",
            Self::Thickness => "thickness",
            Self::Texel => "texel",
        }
    }

    /// Names of its layers in an OpenEXR file.
    #[must_use]
    pub fn layers(self) -> &'static [&'static str] {
        match self {
            Self::Depth => &["Z"],
            Self::Normal => &["normal.X", "normal.Y", "normal.Z"],
            Self::Painted => &["painted"],
            Self::Thickness => &["thickness"],
            Self::Texel => &["texel.X", "texel.Y"],
        }
    }
}
