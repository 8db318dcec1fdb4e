//! Which part of a material pictures are made from.

use clap::{Args, CommandFactory, ValueEnum, error::ErrorKind};

use super::{Cli, CliError, arguments};
use crate::model::{Appearance, TexelSamples};

/// Part of a material, without its settings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Model {
    /// The reflectance on the height field: what is painted
    Svbrdf,
    /// The local PCA: the original's full look
    Lpca,
}

/// Which part, and how it is interpolated.
#[derive(Debug, Clone, Copy, Args)]
pub struct ModelArguments {
    /// What the pictures are made from
    #[arg(long, value_name = "MODEL", value_enum, default_value_t = Model::Svbrdf)]
    model: Model,
    /// With --model lpca: texels that a place is interpolated from. 1 the nearest, 4 bilinear, 9 and 25 softer, 5 of the 9 without the corners [default: 4]
    #[arg(long, value_name = "N", value_parser = arguments::texel_samples())]
    texel_samples: Option<TexelSamples>,
}

impl ModelArguments {
    /// What was typed, the reflectance as a measurement would show it.
    pub fn appearance(self) -> Result<Appearance, CliError> {
        match (self.model, self.texel_samples) {
            (Model::Svbrdf, None) => Ok(Appearance::svbrdf()),
            (Model::Svbrdf, Some(_)) => Err(misplaced("--texel-samples is for --model lpca; leave it out here")),
            (Model::Lpca, samples) => Ok(Appearance::Lpca { texel_samples: samples.unwrap_or_default() }),
        }
    }
}

/// The error of an option that the model does not have.
pub fn misplaced(message: impl std::fmt::Display) -> CliError {
    Cli::command().error(ErrorKind::ArgumentConflict, message).into()
}
