//! Pictures of meshes that wear materials.
//!
//! A picture may be larger than a texture: it is drawn tile by tile. Several rays a pixel are as many pictures, each moved by a part of a
//! pixel, and their mean.

use super::{PipelineError, Progress, tiles::run};
use crate::{
    data::{Camera, Light, Map, Mesh, Window},
    gpu::{Gpu, Target},
    render::{MeshBuffers, MeshPass, Output, Worn},
    stage::Average,
};

/// Columns and rows of a tile at most: 16 MiB of pixels.
const TILE: u32 = 1024;

/// The stages that make pictures of meshes, on one device.
#[derive(Debug)]
pub struct Renderer<'g> {
    gpu: &'g Gpu,
    pass: MeshPass,
    average: Average,
}

impl<'g> Renderer<'g> {
    /// Builds the kernels and render passes.
    ///
    /// # Errors
    /// [`PipelineError::Gpu`] if the driver refuses one.
    pub fn new(gpu: &'g Gpu) -> Result<Self, PipelineError> {
        Ok(Self { gpu, pass: MeshPass::new(gpu)?, average: Average::new(gpu)? })
    }

    /// Uploads `mesh`, whose texture coordinates count `tiling` times.
    ///
    /// # Errors
    /// [`PipelineError::Gpu`] if it does not fit the adapter.
    pub fn upload(&self, mesh: &Mesh, tiling: [f64; 2]) -> Result<MeshBuffers, PipelineError> {
        Ok(MeshBuffers::upload(self.gpu, mesh, tiling)?)
    }

    /// What `output` says of `mesh` wearing `worn`, `[row][column]`: the mean of `samples` rays a pixel, 0 where nothing is.
    ///
    /// # Errors
    /// [`PipelineError::Gpu`] if it does not fit the adapter.
    #[expect(clippy::too_many_arguments, reason = "what a picture is of, and how it is taken")]
    pub fn picture(
        &self, mesh: &MeshBuffers, worn: Worn<'_>, camera: &Camera, lights: &[Light], output: Output, samples: u32, progress: &Progress,
    ) -> Result<Map<[f32; 4]>, PipelineError> {
        let [width, height] = camera.size;
        let mut picture = Map::from_fn(width as usize, height as usize, |_, _| [0.0; 4]);
        for (top, left) in (0..height).step_by(TILE as usize).flat_map(|top| (0..width).step_by(TILE as usize).map(move |left| (top, left)))
        {
            let size = [TILE.min(width - left), TILE.min(height - top)];
            let pixels = size[0] as usize * size[1] as usize;
            let target = Target::new(self.gpu, size[0], size[1])?;
            let mean = self.gpu.fresh("mean picture", pixels)?;
            for sample in 0..samples {
                run(self.gpu, progress, "mesh", [pixels, 1], |recorder| {
                    let [right, down] = within_pixel(sample, samples);
                    let window = Window { corner: [f64::from(left) + right, f64::from(top) + down], size: size.map(f64::from) };
                    self.pass.draw(recorder, mesh, worn, camera, window, lights, output, &target)?;
                    let drawn = target.record_copy(recorder)?;
                    self.average.record(recorder, &drawn, &mean, [size[0] as usize, target.row_pixels()], [sample, samples])
                })?;
            }
            for (index, value) in mean.read(self.gpu)?.into_iter().enumerate() {
                picture[(left as usize + index % size[0] as usize, top as usize + index / size[0] as usize)] = value;
            }
        }
        Ok(picture)
    }
}

/// Where in a pixel sample `index` of `count` lies, from -1/2 to 1/2 about its middle: a sequence whose every part is even (Roberts 2018:
/// the plastic number's R2).
fn within_pixel(index: u32, count: u32) -> [f64; 2] {
    const PLASTIC: f64 = 1.324_717_957_244_746;
    if count == 1 {
        return [0.0; 2];
    }
    [1.0 / PLASTIC, 1.0 / (PLASTIC * PLASTIC)].map(|step| (0.5 + f64::from(index) * step).fract() - 0.5)
}
