//! `overpaint render`.

use std::{
    f64::consts::TAU,
    fs,
    path::{Path, PathBuf},
};

use clap::{Args, CommandFactory, error::ErrorKind};

use super::{
    Cli, CliError, arguments,
    mesh::{self, MeshArguments},
    model::misplaced,
    output,
    painting::{Painting, PaintingArguments},
    session::{Session, SessionArguments},
};
use crate::{
    data::{Direction, Material, MeshView, PlaneView},
    io::{self, job::Job},
    model::{self, Relief},
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
    /// Direction of the view of a plane [default: 40,270]
    #[arg(long, value_name = "THETA,PHI", conflicts_with = "mesh", allow_hyphen_values = true, value_parser = arguments::direction)]
    view: Option<Direction>,
    /// Direction of the light on a plane [default: 50,135]
    #[arg(long, value_name = "THETA,PHI", conflicts_with = "mesh", allow_hyphen_values = true, value_parser = arguments::direction)]
    light: Option<Direction>,
    /// Size of the image in pixels [default: 512x512]
    #[arg(long, value_name = "WxH", allow_hyphen_values = true, value_parser = arguments::picture_size)]
    size: Option<[u32; 2]>,
    /// The image to write: .png (sRGB) or .exr (linear, 32-bit float); of a turntable also .mp4
    #[arg(short, long, value_name = "IMAGE")]
    output: Option<PathBuf>,
    /// Of a turntable, take the pictures that are there as they are
    #[arg(long)]
    resume: bool,
}

/// Columns and rows where nothing else is said.
const SIZE: [u32; 2] = [512, 512];

impl Render {
    pub fn run(self, session: &SessionArguments) -> Result<(), CliError> {
        let from_file = self.material.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"));
        let size = self.size.unwrap_or(SIZE);
        let job = match from_file {
            true if self.mesh.is_given() || self.paint.is_given() || self.size.is_some() || self.view.is_some() || self.light.is_some() => {
                return Err(misplaced(
                    "a job says what is shown, and how; leave out all but -o, --resume, --adapter and --timings, or change the job",
                ));
            }
            true => Some(io::job::load(&self.material)?),
            false => self.mesh.job(&self.material, size)?,
        };
        if self.resume && job.as_ref().is_none_or(|job| job.turntable.is_none()) {
            return Err(misplaced("--resume is for the pictures of a turntable; leave it out, or add --turntable N"));
        }
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
            return self.plane(painting, &output, session);
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
        let renderer = Renderer::new(&session.gpu)?;
        Shooting { job: &job, material: &material, renderer, session: &session }.run(&output, self.resume)?;
        session.finish()?;
        Ok(())
    }

    /// The material as a plane.
    fn plane(&self, painting: Option<Painting>, output: &Path, session: &SessionArguments) -> Result<(), CliError> {
        arguments::image(&output.to_string_lossy()).map_err(|message| Cli::command().error(ErrorKind::ValueValidation, message))?;
        let size = self.size.unwrap_or(SIZE);
        if size.iter().any(|side| *side > arguments::MAX_TEXTURE_SIDE) {
            return Err(misplaced(format!(
                "a plane is drawn in one piece, each side from 1 to {}; --mesh plane has tiles",
                arguments::MAX_TEXTURE_SIDE
            )));
        }
        output::check_file(output)?;
        let mut material = io::material::load(&self.material)?;
        let session = session.open()?;
        if let Some(painting) = painting {
            material = painting.on(&material, &session)?;
        }
        let studio = Studio::new(&session.gpu)?;
        let surface = studio.surface(&material, &session.progress)?;
        let [view, light] = [(self.view, [40.0, 270.0]), (self.light, [50.0, 135.0])]
            .map(|(typed, [theta, phi])| typed.unwrap_or_else(|| Direction::from_degrees(theta, phi)));
        let shot = PlaneView::new(view, light, size);
        let picture = studio.render(&surface, &shot, Relief::default(), &session.progress)?;
        io::picture::write(output, &picture)?;
        session.finish()?;
        Ok(())
    }
}

/// What the pictures of a job are made with.
struct Shooting<'a> {
    job: &'a Job,
    material: &'a Material,
    renderer: Renderer<'a>,
    session: &'a Session,
}

impl Shooting<'_> {
    /// All pictures, or the film of them; with `resume` those that are there are taken as they are.
    fn run(&self, output: &Path, resume: bool) -> Result<(), CliError> {
        let Self { job, material, renderer, session } = self;
        let studio = Studio::new(&session.gpu)?;
        let mut dressed = renderer.dress(&studio, &job.view, material, &session.progress)?;
        let Some(count) = job.turntable else {
            return self.picture(&dressed, &job.view, output, false);
        };
        let film = is_film(output);
        if film {
            let folder = pipeline::frames(output);
            fs::create_dir_all(&folder).map_err(|source| CliError::Write { path: folder, source })?;
        }
        let file = |index| if film { pipeline::frame(output, index) } else { pipeline::numbered(output, index, count) };
        for index in 0..count {
            let file = file(index);
            if resume && file.exists() {
                continue;
            }
            let view = job.view.turned(f64::from(index) / f64::from(count) * TAU);
            renderer.relight(&mut dressed, &view, &session.progress)?;
            self.picture(&dressed, &view, &file, film)?;
        }
        if film {
            pipeline::encode(output, count)?;
            // What is left of the pictures does no harm; a folder with others stays.
            (0..count).for_each(|index| drop(fs::remove_file(file(index))));
            fs::remove_dir(pipeline::frames(output)).ok();
        }
        Ok(())
    }

    /// One picture, into `file`.
    fn picture(&self, dressed: &Dressed, view: &MeshView, file: &Path, on_white: bool) -> Result<(), CliError> {
        let Self { job, material, renderer, session } = self;
        let picture = renderer.radiance(dressed, &view.camera, &session.progress)?;
        if !job.channels.is_empty() {
            let channels = renderer.channels(dressed, &view.camera, material, &job.channels, &session.progress)?;
            return Ok(io::picture::write_channels(file, &picture, channels)?);
        }
        let is_exr = file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("exr"));
        let picture = match (is_exr, on_white) {
            (true, _) => picture,
            (false, false) => picture.map(|&pixel| job.development.develop(pixel)),
            (false, true) => picture.map(|&pixel| model::on_white(job.development.develop(pixel))),
        };
        Ok(io::picture::write(file, &picture)?)
    }
}

fn is_film(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("mp4"))
}
