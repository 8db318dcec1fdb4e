//! The paint that pictures are made with: a recipe, or one layer in a few words.

use std::{fmt::Display, path::PathBuf};

use clap::{Args, CommandFactory, ValueEnum, error::ErrorKind};

use super::{Cli, CliError, arguments, session::Session};
use crate::{
    data::{Material, Recipe},
    io,
    model::{Layer, Paint, PaintMethod, Pattern, Placement, pigments},
    pipeline::Painter,
};

/// Paint to be laid on a material before it is looked at.
#[derive(Debug, Args)]
#[command(next_help_heading = "Paint")]
pub struct PaintingArguments {
    /// Lay on the paint of this recipe (TOML; `overpaint paint --help` shows one)
    #[arg(long, value_name = "FILE", conflicts_with = "paint")]
    recipe: Option<PathBuf>,
    /// Lay on one layer of a paint of the library, with its set or without: "oil/viridian", "viridian"
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
    /// Take paint for a flat colour that is mixed into the picture, for comparison
    #[arg(long)]
    alpha_blend: bool,
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

impl PaintingArguments {
    /// Whether any was typed.
    pub fn is_given(&self) -> bool {
        self.recipe.is_some() || self.paint.is_some() || self.alpha_blend
    }

    /// The paint as typed, read from its files, if there is any.
    pub fn painting(&self) -> Result<Option<Painting>, CliError> {
        let recipe = match &self.recipe {
            Some(path) => Some(io::recipe::load(path)?),
            None => self.layer()?.map(Recipe::of),
        };
        match (recipe, self.alpha_blend) {
            (None, true) => Err(Cli::command()
                .error(ErrorKind::MissingRequiredArgument, "--alpha-blend is for paint; name it with --recipe or --paint")
                .into()),
            (recipe, alpha_blend) => Ok(recipe.map(|recipe| Painting { recipe, method: method(alpha_blend) })),
        }
    }

    fn layer(&self) -> Result<Option<Layer>, CliError> {
        let (Some(paint), Some(thickness)) = (self.paint.clone(), self.thickness) else {
            return Ok(None);
        };
        let pattern = match self.pattern {
            PatternName::Uniform => Pattern::Uniform { drawn: 1.0 },
            PatternName::Splash => Pattern::Splash { seed: self.seed },
            PatternName::Brush => Pattern::Brush { seed: self.seed, width: self.width },
        };
        let placement = Placement { rotation: self.angle.to_radians(), ..Placement::default() };
        let Self { relief, refractive_index, roughness, .. } = *self;
        let layer = Layer { paint, pattern, placement, thickness, relief, refractive_index, roughness };
        Ok(Some(layer.checked().map_err(|error| out_of_range(&error))?))
    }
}

/// Paint and how it is laid on.
#[derive(Debug)]
pub struct Painting {
    recipe: Recipe,
    method: PaintMethod,
}

impl Painting {
    /// The paint of the recipe file `path`.
    pub fn load(path: &std::path::Path, alpha_blend: bool) -> Result<Self, CliError> {
        Ok(Self { recipe: io::recipe::load(path)?, method: method(alpha_blend) })
    }

    /// `material` under it.
    pub fn on(&self, material: &Material, session: &Session) -> Result<Material, CliError> {
        Ok(Painter::new(&session.gpu)?.paint(material, &self.recipe, self.method, &session.progress)?)
    }
}

fn method(alpha_blend: bool) -> PaintMethod {
    if alpha_blend { PaintMethod::AlphaBlend } else { PaintMethod::KubelkaMunk }
}

fn paint(name: &str) -> Result<Paint, String> {
    pigments::find(name).map(Paint::from).map_err(|error| error.to_string())
}

fn out_of_range(error: &dyn Display) -> CliError {
    Cli::command().error(ErrorKind::ValueValidation, error).into()
}
