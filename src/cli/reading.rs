//! What the user knows better than a reader, and what part of a source is wanted.

use clap::Args;

use super::arguments;
use crate::{
    data::{Block, RowOrder, Transfer},
    io::ReadOptions,
};

/// Arguments of every command that reads a source.
#[derive(Debug, Args)]
#[command(next_help_heading = "Reading the source")]
pub struct ReadingArguments {
    /// From stored values to linear ones: srgb, linear or gamma:G; integers are taken as sRGB, floating-point numbers and images with a light file as linear
    #[arg(long, value_name = "CURVE", value_parser = arguments::transfer)]
    transfer: Option<Transfer>,
    /// Whether the stored values have the light's cosine in them, as photographs do; where they do not, it is multiplied in
    #[arg(long, value_name = "HOW", value_parser = arguments::cosine())]
    cosine: Option<bool>,
    /// Which row is stored first
    #[arg(long, value_name = "ORDER", value_parser = arguments::rows())]
    rows: Option<RowOrder>,
    /// Factor from linear values to reflectance units: a white Lambertian surface lit at THETA reads cos THETA
    #[arg(long, value_name = "FACTOR", allow_negative_numbers = true, value_parser = arguments::positive)]
    scale: Option<f64>,
    /// Only these texels: W columns and H rows from column X, row Y
    #[arg(long, value_name = "X,Y,WxH", allow_hyphen_values = true, value_parser = arguments::region)]
    region: Option<Block>,
    /// Only every N-th view and every N-th light, and the view nearest to the zenith
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = arguments::step)]
    every: Option<usize>,
    /// Only views and lights up to this angle from the normal
    #[arg(long, value_name = "DEG", allow_negative_numbers = true, value_parser = arguments::angle_from_normal)]
    max_theta: Option<f64>,
}

impl ReadingArguments {
    /// As a reader takes them.
    pub fn options(&self) -> ReadOptions {
        let &Self { transfer, cosine, rows, scale, region, every, max_theta } = self;
        ReadOptions { transfer, includes_cosine: cosine, rows, scale, region, every, max_theta }
    }

    /// Whether any was typed.
    pub fn is_given(&self) -> bool {
        self.options() != ReadOptions::default()
    }
}
