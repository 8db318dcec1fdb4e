//! `overpaint paint`.

use std::path::PathBuf;

use clap::Args;

use super::{CliError, output, painting::Painting, session::SessionArguments};
use crate::io;

/// Lay the paint of a recipe on a material, which stays a material.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  overpaint paint cloth.zarr --recipe splash.toml -o painted.zarr
  overpaint render painted.zarr -o painted.png

A recipe:
  [canvas]
  repeat = [2, 2]                          # pieces of the material side by side

  [[layer]]                                # from the bottom up
  paint = \"oil/cobalt blue\"                # `overpaint paints` lists them
  pattern = { kind = \"splash\", seed = 3 }  # draws a thickness from 0 to 1
  thickness = 4                            # Kubelka-Munk thickness where it draws 1
  relief = 1.5                             # and height in texel widths

The README has all keys, and how to give paints of your own.")]
pub struct Paint {
    /// The material, as `fit` wrote it; if it is painted, the paint goes on top
    material: PathBuf,
    /// The recipe (TOML)
    #[arg(long, value_name = "FILE")]
    recipe: PathBuf,
    /// Take paint for a flat colour that is mixed into the picture, for comparison
    #[arg(long)]
    alpha_blend: bool,
    /// The painted material to write, a Zarr folder
    #[arg(short, long, value_name = "PAINTED.zarr")]
    output: PathBuf,
}

impl Paint {
    pub fn run(self, session: &SessionArguments) -> Result<(), CliError> {
        let painting = Painting::load(&self.recipe, self.alpha_blend)?;
        output::check_material(&self.output)?;
        let material = io::material::load(&self.material)?;
        let session = session.open()?;
        let painted = painting.on(&material, &session)?;
        io::material::save(&self.output, &painted)?;
        session.finish()?;
        Ok(())
    }
}
