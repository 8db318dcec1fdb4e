//! Meshes on the command line: what wears the material, and how it is looked at.

use std::path::PathBuf;

use clap::Args;
use glam::DVec3;

use super::{CliError, arguments, model::Model, session::Session};
use crate::{
    data::{Camera, Light, Map, Material, Mesh, Projection, Shape},
    io,
    model::{Appearance, Relief, TexelSamples},
    pipeline::{Renderer, Studio, Subject},
    render::{Output, Worn},
};

/// A mesh that wears the material.
#[derive(Debug, Args)]
#[command(next_help_heading = "Mesh")]
pub struct MeshArguments {
    /// Show the material on a mesh: plane, sphere, torus-knot or cloth, or a file (.obj, .gltf, .glb)
    #[arg(long, value_name = "MESH")]
    mesh: Option<PathBuf>,
    /// Pieces of the material per unit of texture coordinates
    #[arg(long, value_name = "N", requires = "mesh", default_value_t = 1.0, value_parser = arguments::positive)]
    tiling: f64,
    /// Where the camera stands: azimuth from the front to the right, and elevation, in degrees
    #[arg(long, value_name = "AZIMUTH,ELEVATION", requires = "mesh", default_value = "30,20", allow_hyphen_values = true, value_parser = arguments::bearing)]
    camera: [f64; 2],
    /// Angle of view in degrees between the upper and the lower edge; 0 is a camera of parallel rays
    #[arg(long, value_name = "DEGREES", requires = "mesh", default_value_t = 30.0, value_parser = arguments::angle_of_view)]
    angle_of_view: f64,
    /// A light at infinity, as --camera; may be given several times [default: -40,50]
    #[arg(long, value_name = "AZIMUTH,ELEVATION", requires = "mesh", allow_hyphen_values = true, value_parser = arguments::bearing)]
    sun: Vec<[f64; 2]>,
    /// What the bare part is made from
    #[arg(long, value_name = "MODEL", requires = "mesh", value_enum, default_value_t = Model::Svbrdf)]
    unpainted: Model,
    /// With --unpainted lpca: texels that a place is interpolated from: 1, 4, 5, 9 or 25
    #[arg(long, value_name = "N", requires = "mesh", default_value = "5", value_parser = arguments::texel_samples())]
    texel_samples: TexelSamples,
    /// Rays a pixel
    #[arg(long, value_name = "N", requires = "mesh", default_value_t = 4, value_parser = clap::value_parser!(u32).range(1..=4096))]
    spp: u32,
}

/// The light where none is given, azimuth and elevation in degrees.
const SUN: [f64; 2] = [-40.0, 50.0];

impl MeshArguments {
    /// The mesh as typed, read from its file, if there is one. What was made up for it is told on stderr.
    pub fn mesh(&self) -> Result<Option<Mesh>, CliError> {
        let Some(path) = &self.mesh else { return Ok(None) };
        if let Some(shape) = Shape::ALL.into_iter().find(|shape| path.as_os_str() == shape.name()) {
            return Ok(Some(shape.mesh()));
        }
        let loaded = io::mesh::load(path)?;
        for warning in &loaded.warnings {
            eprintln!("warning: {warning}");
        }
        Ok(Some(loaded.mesh))
    }

    /// `mesh` wearing `material`, `size` in pixels.
    pub fn picture(&self, mesh: &Mesh, material: &Material, size: [u32; 2], session: &Session) -> Result<Map<[f32; 4]>, CliError> {
        let (studio, renderer) = (Studio::new(&session.gpu)?, Renderer::new(&session.gpu)?);
        let surface = studio.surface(material, &session.progress)?;
        let compressed = match self.unpainted {
            Model::Svbrdf => None,
            Model::Lpca => Some(studio.subject(material, Appearance::Lpca { texel_samples: self.texel_samples }, &session.progress)?),
        };
        let compressed = match &compressed {
            Some(Subject::Compressed { btf, texel_samples }) => Some((btf.as_ref(), *texel_samples)),
            _ => None,
        };
        let worn = Worn { surface: &surface, compressed, relief: Relief::default(), silhouette: false };

        let [low, high] = mesh.bounds().map(|corner| DVec3::from_array(corner.map(f64::from)));
        let projection = match self.angle_of_view {
            0.0 => Projection::Orthographic { height: 1.0 },
            degrees => Projection::Perspective { field_of_view: degrees.to_radians() },
        };
        let radius =
            mesh.positions().iter().map(|&place| DVec3::from_array(place.map(f64::from)).distance(0.5 * (low + high))).fold(0.0, f64::max);
        let camera = Camera::around(0.5 * (low + high), radius, self.camera.map(f64::to_radians), projection, size);
        let suns = if self.sun.is_empty() { &[SUN][..] } else { &self.sun };
        let sun = |bearing: &[f64; 2]| Light::Directional { toward: Camera::bearing(bearing.map(f64::to_radians)), irradiance: [1.0; 3] };
        let lights: Vec<_> = suns.iter().map(sun).collect();
        let mesh = renderer.upload(mesh, [self.tiling; 2])?;
        Ok(renderer.picture(&mesh, worn, &camera, &lights, Output::Radiance, self.spp, &session.progress)?)
    }
}
