//! `overpaint render`.

use std::{
    f64::consts::TAU,
    path::{Path, PathBuf},
};

use clap::{Args, CommandFactory, error::ErrorKind};

use super::{
    Cli, CliError, arguments,
    mesh::{self, MeshArguments},
    output,
    painting::{Painting, PaintingArguments},
    session::{Session, SessionArguments},
};
use crate::{
    data::{Direction, Material, MeshView, PlaneView},
    io::{self, job::Job},
    model::Relief,
    pipeline::{self, Dressed, Renderer, Studio},
};

/// Show a material as a plane in space or on a mesh, bare or painted.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  overpaint render cloth.zarr -o cloth.png
  overpaint render cloth.zarr --paint \"watercolour/cadmium yellow\" --thickness 0.3 -o painted.png
  overpaint render cloth.zarr --recipe splash.toml -o splashed.png
  overpaint render cloth.zarr --paint \"oil/cobalt blue\" --thickness 4 --relief 2 --view 50,270 --light 60,120 --size 1024x768 -o painted.exr
  overpaint render cloth.zarr --mesh spot.obj --tiling 4 --unpainted lpca --size 768x768 -o spot.png
  overpaint render cloth.zarr --mesh torus-knot --channels depth,normal,texel -o knot.exr
  overpaint render cloth.zarr --mesh cloth --turntable 96 -o turn.mp4
  overpaint render job.toml

A job is what the options say, as a TOML file:
  material = \"cloth.zarr\"
  recipe = \"splash.toml\"
  output = \"spot.exr\"
  size = [768, 768]
  unpainted = \"lpca\"
  channels = [\"depth\", \"thickness\"]
  mesh = { file = \"spot.obj\", tiling = 4 }
  camera = { azimuth = 150, elevation = 10 }
  [[light]]
  azimuth = -40
  elevation = 50
  irradiance = [1, 0.95, 0.9]")]
pub struct Render {
    /// The material, as `fit` or `paint` wrote it; or a job (.toml)
    material: PathBuf,
    #[command(flatten)]
    paint: PaintingArguments,
    #[command(flatten)]
    mesh: MeshArguments,
    /// Direction of the view of a plane
    #[arg(long, value_name = "THETA,PHI", default_value = "40,270", conflicts_with = "mesh", allow_hyphen_values = true, value_parser = arguments::direction)]
    view: Direction,
    /// Direction of the light on a plane
    #[arg(long, value_name = "THETA,PHI", default_value = "50,135", conflicts_with = "mesh", allow_hyphen_values = true, value_parser = arguments::direction)]
    light: Direction,
    /// Size of the image in pixels
    #[arg(long, value_name = "WxH", default_value = "512x512", allow_hyphen_values = true, value_parser = arguments::size)]
    size: [u32; 2],
    /// The image to write: .png (sRGB) or .exr (linear, 32-bit float); of a turntable also .mp4
    #[arg(short, long, value_name = "IMAGE")]
    output: Option<PathBuf>,
    /// Of a turntable, take the pictures that are there as they are
    #[arg(long)]
    resume: bool,
}

impl Render {
    pub fn run(self, session: &SessionArguments) -> Result<(), CliError> {
        let from_file = self.material.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"));
        let job = if from_file { Some(io::job::load(&self.material)?) } else { self.mesh.job(&self.material, self.size)? };
        let painting = match job.as_ref().and_then(|job| job.recipe.as_ref()) {
            Some(recipe) => Some(Painting::load(recipe, false)?),
            None => self.paint.painting()?,
        };
        let output = self.output.clone().or(job.as_ref().and_then(|job| job.output.clone()));
        let output = output.ok_or_else(|| {
            Cli::command()
                .error(ErrorKind::MissingRequiredArgument, "nothing says where the picture goes; name it with -o, such as -o picture.png")
        })?;
        let Some(job) = job else {
            return self.plane(painting, &arguments::image(&output.to_string_lossy()), session);
        };
        mesh::check(&job, &output)?;
        output::check_file(&output)?;
        if job.turntable.is_some() && is_film(&output) {
            pipeline::check_ffmpeg()?;
        }
        for warning in &job.warnings {
            eprintln!("warning: {warning}");
        }
        let mut material = io::material::load(&job.material)?;
        let session = session.open()?;
        if let Some(painting) = painting {
            material = painting.on(&material, &session)?;
        }
        self.shoot(&job, &material, &output, &session)?;
        session.finish()?;
        Ok(())
    }

    /// The material as a plane.
    fn plane(&self, painting: Option<Painting>, output: &Result<PathBuf, String>, session: &SessionArguments) -> Result<(), CliError> {
        let output = output.as_ref().map_err(|message| Cli::command().error(ErrorKind::ValueValidation, message))?;
        output::check_file(output)?;
        let mut material = io::material::load(&self.material)?;
        let session = session.open()?;
        if let Some(painting) = painting {
            material = painting.on(&material, &session)?;
        }
        let studio = Studio::new(&session.gpu)?;
        let surface = studio.surface(&material, &session.progress)?;
        let shot = PlaneView::new(self.view, self.light, self.size);
        let picture = studio.render(&surface, &shot, Relief::default(), &session.progress)?;
        io::picture::write(output, &picture)?;
        session.finish()?;
        Ok(())
    }

    /// The pictures of a job.
    fn shoot(&self, job: &Job, material: &Material, output: &Path, session: &Session) -> Result<(), CliError> {
        let (studio, renderer) = (Studio::new(&session.gpu)?, Renderer::new(&session.gpu)?);
        let mut dressed = renderer.dress(&studio, &job.view, material, &session.progress)?;
        let Some(count) = job.turntable else {
            return picture(&renderer, &dressed, &job.view, job, material, output, session);
        };
        let frames = if is_film(output) { output.with_extension("####.png") } else { output.to_owned() };
        for index in 0..count {
            let file = pipeline::numbered(&frames, index, count);
            if self.resume && file.exists() {
                continue;
            }
            let view = job.view.turned(f64::from(index) / f64::from(count) * TAU);
            renderer.relight(&mut dressed, &view, &session.progress)?;
            picture(&renderer, &dressed, &view, job, material, &file, session)?;
        }
        if is_film(output) {
            pipeline::encode(&frames, count, output)?;
            for index in 0..count {
                // What is left of them does no harm.
                std::fs::remove_file(pipeline::numbered(&frames, index, count)).ok();
            }
        }
        Ok(())
    }
}

fn is_film(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("mp4"))
}

/// One picture of a job, into `file`.
fn picture(
    renderer: &Renderer<'_>, dressed: &Dressed, view: &MeshView, job: &Job, material: &Material, file: &Path, session: &Session,
) -> Result<(), CliError> {
    let picture = renderer.radiance(dressed, &view.camera, &session.progress)?;
    if !job.channels.is_empty() {
        let channels = renderer.channels(dressed, &view.camera, material, &job.channels, &session.progress)?;
        return Ok(io::picture::write_channels(file, &picture, &channels)?);
    }
    let is_exr = file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("exr"));
    let picture = if is_exr { picture } else { picture.map(|&pixel| job.development.develop(pixel)) };
    Ok(io::picture::write(file, &picture)?)
}
