//! Meshes on the command line: what wears the material, how it is looked at, and the pictures of it.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use clap::{Args, CommandFactory, ValueEnum, error::ErrorKind};

use super::{
    Cli, CliError, arguments,
    model::{Model, misplaced},
};
use crate::{
    data::{Camera, Channel, Light, Mesh, MeshView, Sampling, Shape, Surroundings},
    io::{
        self,
        job::{self, Job, MAX_LIGHTS},
    },
    model::{Development, TexelSamples, ToneMap},
};

/// A mesh that wears the material.
#[derive(Debug, Args)]
#[command(next_help_heading = "Mesh")]
pub struct MeshArguments {
    /// Show the material on a mesh: plane, sphere, torus-knot or cloth, or a file (.obj, .gltf, .glb)
    #[arg(long, value_name = "MESH")]
    mesh: Option<PathBuf>,
    /// Pieces of the material per unit of texture coordinates
    #[arg(long, value_name = "N", requires = "mesh", default_value_t = 1.0, allow_negative_numbers = true, value_parser = arguments::within(1e-3, 1e4))]
    tiling: f64,
    /// Where the camera stands: azimuth from the front to the right, and elevation, in degrees
    #[arg(long, value_name = "AZIMUTH,ELEVATION", requires = "mesh", default_value = "30,20", allow_hyphen_values = true, value_parser = arguments::bearing)]
    camera: [f64; 2],
    /// Angle of view in degrees between the upper and the lower edge; 0 is a camera of parallel rays
    #[arg(long, value_name = "DEGREES", requires = "mesh", default_value_t = MeshView::ANGLE_OF_VIEW, value_parser = arguments::angle_of_view)]
    angle_of_view: f64,
    /// A light far away, as --camera; may be given several times [default: one from the upper left and a weak one from the right]
    #[arg(long, value_name = "AZIMUTH,ELEVATION", requires = "mesh", allow_hyphen_values = true, value_parser = arguments::bearing)]
    sun: Vec<[f64; 2]>,
    /// A light near by, in units of the mesh; white that faces it at distance 1 reads 1; may be given several times
    #[arg(long, value_name = "X,Y,Z", requires = "mesh", allow_hyphen_values = true, value_parser = arguments::place)]
    lamp: Vec<[f64; 3]>,
    /// What is around the mesh: studio, sky, or an equirectangular picture in linear light (.hdr, .exr); without --sun and --lamp the only light
    #[arg(long, value_name = "ENVIRONMENT", requires = "mesh")]
    environment: Option<PathBuf>,
    /// Factor on the light of --environment
    #[arg(long, value_name = "N", requires = "environment", default_value_t = 1.0, allow_negative_numbers = true, value_parser = arguments::within(1e-6, 1e6))]
    environment_strength: f64,
    /// How far --environment is turned about the vertical axis, its front to the right, in degrees
    #[arg(long, value_name = "DEGREES", requires = "environment", default_value_t = 0.0, allow_negative_numbers = true, value_parser = arguments::number)]
    environment_turn: f64,
    /// The mesh throws no shadows on itself
    #[arg(long, requires = "mesh")]
    no_mesh_shadows: bool,
    /// Rays that leave the sheet of texture coordinates 0 to 1 see through it: its edges show the relief
    #[arg(long, requires = "mesh")]
    silhouettes: bool,
    /// What the bare part is made from
    #[arg(long, value_name = "MODEL", requires = "mesh", value_enum, default_value_t = Model::Svbrdf)]
    unpainted: Model,
    /// With --unpainted lpca: texels that a place is interpolated from: 1, 4, 5, 9 or 25 [default: 5]
    #[arg(long, value_name = "N", requires = "mesh", value_parser = arguments::texel_samples())]
    texel_samples: Option<TexelSamples>,
    /// Rays a pixel
    #[arg(long, value_name = "N", requires = "mesh", default_value_t = 4, value_parser = clap::value_parser!(u32).range(1..=4096))]
    spp: u32,
    /// What an .exr has beside its colours, separated by commas
    #[arg(long, value_name = "CHANNELS", requires = "mesh", value_enum, value_delimiter = ',')]
    channels: Vec<ChannelName>,
    /// Powers of two that a .png is brighter by
    #[arg(long, value_name = "STOPS", requires = "mesh", default_value_t = 0.0, allow_negative_numbers = true, value_parser = arguments::within(-20.0, 20.0))]
    exposure: f64,
    /// How light that may exceed 1 is shown by a .png
    #[arg(long, value_name = "MAP", requires = "mesh", value_enum, default_value_t = ToneMapName::Neutral)]
    tone_map: ToneMapName,
    /// Pictures of a whole turn of the mesh: their number stands for the #s in the picture's name; or a film, if it ends in .mp4
    #[arg(long, value_name = "PICTURES", requires = "mesh", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    turntable: Option<u32>,
}

/// A channel of an EXR.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum ChannelName {
    /// Distance from the eye's plane: Z
    Depth,
    /// Normal of the surface met, in the world: normal.X, .Y, .Z
    Normal,
    /// Coverage of paint
    Painted,
    /// Height of the paint, in texel widths
    Thickness,
    /// Column and row of the texel met: texel.X, .Y
    Texel,
}

/// A tone map.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum ToneMapName {
    /// Khronos PBR Neutral
    Neutral,
    /// What exceeds 1 is 1
    Clip,
}

impl MeshArguments {
    /// Whether a mesh was typed, without which nothing else of it can be.
    pub fn is_given(&self) -> bool {
        self.mesh.is_some()
    }

    /// The pictures as typed, of `material`, if they are of a mesh.
    pub fn job(&self, material: &Path, size: [u32; 2]) -> Result<Option<Job>, CliError> {
        let Some(mesh) = &self.mesh else { return Ok(None) };
        let (mesh, mut warnings) = named(mesh)?;
        if self.texel_samples.is_some() && self.unpainted != Model::Lpca {
            return Err(misplaced("--texel-samples tells of the local PCA; leave it out, or add --unpainted lpca"));
        }
        if self.sun.len() + self.lamp.len() > MAX_LIGHTS {
            return Err(misplaced(format!("at most {MAX_LIGHTS} lights shine on a mesh; name fewer with --sun and --lamp")));
        }
        let mut lights: Vec<_> = self.sun.iter().map(|bearing| Light::sun(*bearing, [1.0; 3])).collect();
        lights.extend(self.lamp.iter().map(|place| Light::Point { place: (*place).into(), irradiance: [1.0; 3] }));
        let surroundings = self.environment.as_ref().map(|environment| job::environment(environment)).transpose()?;
        let surroundings = surroundings.map(|(environment, told)| {
            warnings.extend(told);
            let (strength, turn) = (self.environment_strength, self.environment_turn.to_radians());
            Surroundings { environment: Arc::new(environment), strength, turn }
        });
        if lights.is_empty() && surroundings.is_none() {
            lights = Light::pair();
        }
        let camera = Camera::showing(&mesh, self.camera, self.angle_of_view, size, self.turntable.is_some());
        let view = MeshView {
            tiling: [self.tiling; 2],
            surroundings,
            shadows: !self.no_mesh_shadows,
            silhouette: self.silhouettes,
            unpainted: (self.unpainted == Model::Lpca).then(|| self.texel_samples.unwrap_or_default()),
            sampling: Sampling { pictures: self.spp, ..Sampling::default() },
            ..MeshView::new(mesh, camera, lights)
        };
        let channels = self.channels.iter().map(|channel| match channel {
            ChannelName::Depth => Channel::Depth,
            ChannelName::Normal => Channel::Normal,
            ChannelName::Painted => Channel::Painted,
            ChannelName::Thickness => Channel::Thickness,
            ChannelName::Texel => Channel::Texel,
        });
        let tone_map = match self.tone_map {
            ToneMapName::Neutral => ToneMap::Neutral,
            ToneMapName::Clip => ToneMap::Clip,
        };
        Ok(Some(Job {
            material: material.to_owned(),
            recipe: None,
            output: None,
            view,
            channels: job::distinct(channels.collect()),
            development: Development { exposure: self.exposure, tone_map },
            turntable: self.turntable,
            warnings,
        }))
    }
}

/// A built-in shape by its name, or the mesh of a file, and what was made up for it.
pub fn named(mesh: &Path) -> Result<(Mesh, Vec<String>), CliError> {
    if let Some(shape) = Shape::ALL.into_iter().find(|shape| mesh.as_os_str() == shape.name()) {
        return Ok((shape.mesh(), Vec::new()));
    }
    if mesh.extension().is_none() && !mesh.exists() {
        let shapes = Shape::ALL.map(Shape::name).join(", ");
        let message = format!("{} is neither a mesh of this program ({shapes}) nor a file", mesh.display());
        return Err(Cli::command().error(ErrorKind::ValueValidation, message).into());
    }
    let loaded = io::mesh::load(mesh)?;
    Ok((loaded.mesh, loaded.warnings.iter().map(ToString::to_string).collect()))
}

/// Refuses what the kind of the output does not have.
pub fn check(job: &Job, output: &Path) -> Result<(), CliError> {
    let extension = output.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase());
    let refuse = |message: &str| Err(Cli::command().error(ErrorKind::ArgumentConflict, message).into());
    match (extension.as_deref(), job.turntable) {
        (Some("mp4"), None) => refuse("a film is of a turntable; add --turntable N, or name a .png or .exr"),
        (Some("exr"), _) if job.development != Development::default() => {
            refuse("an .exr is linear light as it is; leave exposure and tone map out, or name a .png")
        }
        (Some("png" | "mp4"), _) if !job.channels.is_empty() => {
            refuse("only an .exr has further channels; name one, or leave --channels out")
        }
        (Some("png" | "exr"), Some(pictures)) if pictures > 1 && !name(output).contains('#') => refuse(
            "the pictures of a turntable are numbered; put #s into the name where the number goes, such as turn_###.png, or name an .mp4",
        ),
        (Some("png" | "exr" | "mp4"), _) => Ok(()),
        _ => refuse("the output must end in .png (sRGB), .exr (linear, 32-bit float) or, of a turntable, .mp4"),
    }
}

fn name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}
