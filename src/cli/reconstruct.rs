//! `overpaint reconstruct`.

use std::path::PathBuf;

use clap::Args;

use super::{
    CliError, arguments,
    model::{ModelArguments, misplaced},
    output,
    painting::PaintingArguments,
    session::SessionArguments,
};
use crate::{data::Direction, io, model::Appearance, pipeline::Studio};

/// Show what the source would have recorded under a view and a light, measured or not.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  overpaint reconstruct cloth.zarr --view 0,0 --light 45,90 -o cloth.png
  overpaint reconstruct cloth.zarr --recipe splash.toml --view 0,0 --light 45,90 -o splashed.png
  overpaint reconstruct cloth.zarr --model lpca --view 30,270 --light 61.5,12 -o cloth.exr
  overpaint reconstruct cloth.zarr --model lpca --view 0,0 --light 0,90 --to-light 75,90 --sweep 16 -o strip.png

The image has one pixel a texel, in reflectance units (a white Lambertian plane lit at THETA reads cos THETA).")]
pub struct Reconstruct {
    /// The material, as `fit` or `paint` wrote it
    material: PathBuf,
    #[command(flatten)]
    model: ModelArguments,
    #[command(flatten)]
    paint: PaintingArguments,
    /// Direction of the view
    #[arg(long, value_name = "THETA,PHI", allow_hyphen_values = true, value_parser = arguments::direction)]
    view: Direction,
    /// Direction of the light
    #[arg(long, value_name = "THETA,PHI", allow_hyphen_values = true, value_parser = arguments::direction)]
    light: Direction,
    /// This many pictures side by side, THETA and PHI going evenly from --view to --to-view and from --light to --to-light
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = clap::value_parser!(u16).range(2..=256))]
    sweep: Option<u16>,
    /// Direction of the last picture's view, that of the first if left out
    #[arg(long, value_name = "THETA,PHI", requires = "sweep", allow_hyphen_values = true, value_parser = arguments::direction)]
    to_view: Option<Direction>,
    /// Direction of the last picture's light, that of the first if left out
    #[arg(long, value_name = "THETA,PHI", requires = "sweep", allow_hyphen_values = true, value_parser = arguments::direction)]
    to_light: Option<Direction>,
    /// The image to write: .png (sRGB) or .exr (linear, 32-bit float)
    #[arg(short, long, value_name = "IMAGE", value_parser = arguments::image)]
    output: PathBuf,
}

impl Reconstruct {
    pub fn run(self, session: &SessionArguments) -> Result<(), CliError> {
        let appearance = self.model.appearance()?;
        let painting = self.paint.painting()?;
        if painting.is_some() && matches!(appearance, Appearance::Lpca { .. }) {
            return Err(misplaced("paint is laid on the reflectance; leave out --model lpca, which shows the bare original"));
        }
        output::check_file(&self.output)?;
        let mut material = io::material::load(&self.material)?;
        let session = session.open()?;
        if let Some(painting) = painting {
            material = painting.on(&material, &session)?;
        }
        let studio = Studio::new(&session.gpu)?;
        let subject = studio.subject(&material, appearance, &session.progress)?;
        let end = [self.to_view.unwrap_or(self.view), self.to_light.unwrap_or(self.light)];
        let count = self.sweep.map_or(1, usize::from);
        let picture = studio.strip(&subject, [self.view, self.light], end, count, &session.progress)?;
        io::picture::write(&self.output, &picture)?;
        session.finish()?;
        Ok(())
    }
}
