//! `overpaint reconstruct`.

use std::path::PathBuf;

use clap::Args;

use super::{CliError, arguments, output, session::SessionArguments};
use crate::{data::Direction, io, model::Relief, pipeline::Studio};

/// Show what the source would have recorded under a view and a light, measured or not.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  overpaint reconstruct cloth.zarr --view 0,0 --light 45,90 -o cloth.png
  overpaint reconstruct cloth.zarr --view 30,270 --light 61.5,12 -o cloth.exr

The image has one pixel a texel, in reflectance units (a white Lambertian plane lit at THETA reads cos THETA).")]
pub struct Reconstruct {
    /// The material, as `fit` wrote it
    material: PathBuf,
    /// Direction of the view
    #[arg(long, value_name = "THETA,PHI", allow_hyphen_values = true, value_parser = arguments::direction)]
    view: Direction,
    /// Direction of the light
    #[arg(long, value_name = "THETA,PHI", allow_hyphen_values = true, value_parser = arguments::direction)]
    light: Direction,
    /// The image to write: .png (sRGB) or .exr (linear, 32-bit float)
    #[arg(short, long, value_name = "IMAGE", value_parser = arguments::image)]
    output: PathBuf,
}

impl Reconstruct {
    pub fn run(self, session: &SessionArguments) -> Result<(), CliError> {
        output::check_file(&self.output)?;
        let material = io::material::load(&self.material)?;
        let session = session.open()?;
        let studio = Studio::new(&session.gpu)?;
        let surface = studio.surface(&material, None, &session.progress)?;
        let picture = studio.reconstruct(&surface, self.view, self.light, Relief::measured(), &session.progress)?;
        io::picture::write(&self.output, &picture)?;
        session.finish()?;
        Ok(())
    }
}
