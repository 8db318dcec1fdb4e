//! Meshes on the command line: what wears the material, and how it is looked at.

use std::path::PathBuf;

use clap::Args;

use super::{CliError, arguments, model::Model};
use crate::{
    data::{Camera, Light, Mesh, MeshView, Projection, Sampling, Shape},
    io,
    model::TexelSamples,
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
    fn mesh(&self) -> Result<Option<Mesh>, CliError> {
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

    /// How the mesh is looked at, `size` in pixels, if there is one.
    pub fn view(&self, size: [u32; 2]) -> Result<Option<MeshView>, CliError> {
        let Some(mesh) = self.mesh()? else { return Ok(None) };
        let projection = match self.angle_of_view {
            0.0 => Projection::Orthographic { height: 1.0 },
            degrees => Projection::Perspective { field_of_view: degrees.to_radians() },
        };
        let (center, radius) = mesh.ball();
        let camera = Camera::around(center, radius, self.camera.map(f64::to_radians), projection, size);
        let suns = if self.sun.is_empty() { &[SUN][..] } else { &self.sun };
        let sun = |bearing: &[f64; 2]| Light::Directional { toward: Camera::bearing(bearing.map(f64::to_radians)), irradiance: [1.0; 3] };
        Ok(Some(MeshView {
            tiling: [self.tiling; 2],
            unpainted: (self.unpainted == Model::Lpca).then_some(self.texel_samples),
            sampling: Sampling { pictures: self.spp, ..Sampling::default() },
            ..MeshView::new(mesh, camera, suns.iter().map(sun).collect())
        }))
    }
}
