//! `overpaint render`.

use std::{fmt::Display, path::PathBuf};

use clap::{Args, CommandFactory, ValueEnum, error::ErrorKind};

use super::{Cli, CliError, arguments, output, session::SessionArguments};
use crate::{
    data::{Direction, PlaneView, Recipe},
    io,
    model::{Layer, Paint, Pattern, Placement, Relief, pigments},
    pipeline::Studio,
};

/// Show a material as a plane in space, bare or painted.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  overpaint render cloth.zarr -o cloth.png
  overpaint render cloth.zarr --paint \"watercolour/cadmium yellow\" --thickness 0.3 -o painted.png
  overpaint render cloth.zarr --paint \"oil/cobalt blue\" --thickness 4 --relief 2 --view 50,270 --light 60,120 --size 1024x768 -o painted.exr")]
pub struct Render {
    /// The material, as `fit` wrote it
    material: PathBuf,
    #[command(flatten)]
    paint: PaintArguments,
    /// Direction of the view
    #[arg(long, value_name = "THETA,PHI", default_value = "40,270", allow_hyphen_values = true, value_parser = arguments::direction)]
    view: Direction,
    /// Direction of the light
    #[arg(long, value_name = "THETA,PHI", default_value = "50,135", allow_hyphen_values = true, value_parser = arguments::direction)]
    light: Direction,
    /// Size of the image in pixels
    #[arg(long, value_name = "WxH", default_value = "512x512", allow_hyphen_values = true, value_parser = arguments::size)]
    size: [u32; 2],
    /// The image to write: .png (sRGB) or .exr (linear, 32-bit float)
    #[arg(short, long, value_name = "IMAGE", value_parser = arguments::image)]
    output: PathBuf,
}

/// The layer of paint as typed.
#[derive(Debug, Args)]
#[command(next_help_heading = "Paint")]
struct PaintArguments {
    /// A paint of the library, with its set or without: "oil/viridian", "viridian"
    #[arg(long, value_name = "NAME", requires = "thickness", value_parser = paint)]
    paint: Option<Paint>,
    /// Kubelka-Munk thickness where the pattern is full, in the unit of the paint's set
    #[arg(long, value_name = "D", requires = "paint", allow_negative_numbers = true, value_parser = arguments::not_negative)]
    thickness: Option<f64>,
    /// How the paint is laid on
    #[arg(long, requires = "paint", value_enum, default_value_t = PatternName::Uniform)]
    pattern: PatternName,
    /// Which splash or which stroke
    #[arg(long, value_name = "N", requires = "paint", default_value_t = 1)]
    seed: u32,
    /// Direction of the brush stroke in degrees, counter-clockwise from the right
    #[arg(long, value_name = "PHI", requires = "paint", default_value_t = 0.0, allow_negative_numbers = true, value_parser = arguments::number)]
    angle: f64,
    /// Width of the brush stroke, as a part of the material's shorter edge
    #[arg(long, value_name = "W", requires = "paint", default_value_t = 0.3, allow_negative_numbers = true, value_parser = arguments::positive)]
    width: f64,
    /// Height of the paint where the pattern is full, in texel widths
    #[arg(long, value_name = "H", requires = "paint", default_value_t = 0.0, allow_negative_numbers = true, value_parser = arguments::not_negative)]
    relief: f64,
    /// Refractive index of the binder
    #[arg(long, value_name = "N", requires = "paint", default_value_t = 1.5, allow_negative_numbers = true, value_parser = arguments::refractive_index)]
    refractive_index: f64,
    /// Width of the paint's highlight (GGX alpha)
    #[arg(long, value_name = "A", requires = "paint", default_value_t = 0.3, allow_negative_numbers = true, value_parser = arguments::roughness)]
    roughness: f64,
}

/// A pattern without its settings.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum PatternName {
    /// The same thickness everywhere
    Uniform,
    /// Blobs, fingers and drops
    Splash,
    /// One stroke through the middle
    Brush,
}

impl PaintArguments {
    /// The layer and where it is drawn, if there is one.
    fn painting(self) -> Result<Option<Recipe>, CliError> {
        let (Some(paint), Some(thickness)) = (self.paint, self.thickness) else {
            return Ok(None);
        };
        let (relief, refractive_index, roughness) = (self.relief, self.refractive_index, self.roughness);
        let pattern = match self.pattern {
            PatternName::Uniform => Pattern::Uniform { drawn: 1.0 },
            PatternName::Splash => Pattern::Splash { seed: self.seed },
            PatternName::Brush => Pattern::Brush { seed: self.seed, width: self.width },
        };
        let placement = Placement { rotation: self.angle.to_radians(), ..Placement::default() };
        let layer = Layer { paint, pattern, placement, thickness, relief, refractive_index, roughness };
        let layer = layer.checked().map_err(|error| out_of_range(&error))?;
        layer.pattern.checked().map_err(|error| out_of_range(&error))?;
        Ok(Some(Recipe::of(layer)))
    }
}

fn paint(name: &str) -> Result<Paint, String> {
    pigments::find(name).map(Paint::from).map_err(|error| error.to_string())
}

fn out_of_range(error: &dyn Display) -> CliError {
    Cli::command().error(ErrorKind::ValueValidation, error).into()
}

impl Render {
    pub fn run(self, session: &SessionArguments) -> Result<(), CliError> {
        let painting = self.paint.painting()?;
        output::check_file(&self.output)?;
        let material = io::material::load(&self.material)?;
        let session = session.open()?;
        let studio = Studio::new(&session.gpu)?;
        let surface = studio.surface(&material, painting.as_ref(), &session.progress)?;
        let shot = PlaneView::new(self.view, self.light, self.size);
        let picture = studio.render(&surface, &shot, Relief::default(), &session.progress)?;
        io::picture::write(&self.output, &picture)?;
        session.finish()?;
        Ok(())
    }
}
