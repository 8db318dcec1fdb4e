//! `overpaint render`.

use std::path::PathBuf;

use clap::Args;

use super::{CliError, arguments, mesh::MeshArguments, output, painting::PaintingArguments, session::SessionArguments};
use crate::{
    data::{Direction, PlaneView},
    io,
    model::Relief,
    pipeline::{Renderer, Studio},
    render::Output,
};

/// Show a material as a plane in space or on a mesh, bare or painted.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  overpaint render cloth.zarr -o cloth.png
  overpaint render cloth.zarr --paint \"watercolour/cadmium yellow\" --thickness 0.3 -o painted.png
  overpaint render cloth.zarr --recipe splash.toml -o splashed.png
  overpaint render cloth.zarr --mesh spot.obj --tiling 4 --unpainted lpca --size 768x768 -o spot.png
  overpaint render cloth.zarr --paint \"oil/cobalt blue\" --thickness 4 --relief 2 --view 50,270 --light 60,120 --size 1024x768 -o painted.exr")]
pub struct Render {
    /// The material, as `fit` or `paint` wrote it
    material: PathBuf,
    #[command(flatten)]
    paint: PaintingArguments,
    #[command(flatten)]
    mesh: MeshArguments,
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

impl Render {
    pub fn run(self, session: &SessionArguments) -> Result<(), CliError> {
        let painting = self.paint.painting()?;
        output::check_file(&self.output)?;
        let view = self.mesh.view(self.size)?;
        let mut material = io::material::load(&self.material)?;
        let session = session.open()?;
        if let Some(painting) = painting {
            material = painting.on(&material, &session)?;
        }
        let studio = Studio::new(&session.gpu)?;
        let picture = match &view {
            Some(view) => {
                let renderer = Renderer::new(&session.gpu)?;
                let dressed = renderer.dress(&studio, view, &material, &session.progress)?;
                renderer.picture(&dressed, &view.camera, Output::Radiance, &session.progress)?
            }
            None => {
                let surface = studio.surface(&material, &session.progress)?;
                let shot = PlaneView::new(self.view, self.light, self.size);
                studio.render(&surface, &shot, Relief::default(), &session.progress)?
            }
        };
        io::picture::write(&self.output, &picture)?;
        session.finish()?;
        Ok(())
    }
}
