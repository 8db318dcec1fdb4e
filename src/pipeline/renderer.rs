//! Pictures of meshes that wear materials.
//!
//! A picture may be larger than a texture: it is drawn tile by tile. Several rays a pixel are as many pictures, each moved by a part of a
//! pixel, and their mean.

use glam::DQuat;

use super::{PipelineError, Progress, Studio, tiles::run};
use crate::{
    data::{self, Camera, Channel, Light, Map, Material, MeshView, Sampling, Surroundings, Window},
    gpu::Gpu,
    model::{ENVIRONMENT_SIZE, ENVIRONMENT_SOURCE, Relief, TexelSamples},
    render::{Lighting, Lights, MeshBuffers, MeshPass, MeshTarget, Output, ShadowPass, Shown, SurroundingsBuffers},
    stage::{Average, CompressedBtf, Environment, Minify, Surface},
};

/// Lights that stand for an environment on what is bare, each by a look at the original. Eight give a plane's irradiance within 15 % of all of
/// the built-in environments' light, whichever way it faces (law::mesh_pass).
const AROUND: usize = 8;

/// Columns and rows of a tile at most: 16 MiB of pixels.
const TILE: u32 = 1024;

/// A mesh that wears a material under its lights, in adapter memory, ready to be seen from anywhere.
#[derive(Debug)]
pub struct Dressed {
    mesh: MeshBuffers,
    surface: Surface,
    compressed: Option<(CompressedBtf, TexelSamples)>,
    lighting: Lighting,
    surroundings: SurroundingsBuffers,
    /// What stands for them on the bare part, before they are turned.
    around: Vec<Light>,
    relief: Relief,
    silhouette: bool,
    sampling: Sampling,
}

impl Dressed {
    fn shown(&self) -> Shown<'_> {
        let Self { mesh, surface, lighting, surroundings, relief, silhouette, sampling, .. } = self;
        let compressed = self.compressed.as_ref().map(|(btf, texel_samples)| (btf, *texel_samples));
        Shown { mesh, surface, compressed, relief: *relief, silhouette: *silhouette, lighting, surroundings, sampling: *sampling }
    }
}

/// The stages that make pictures of meshes, on one device.
#[derive(Debug)]
pub struct Renderer<'g> {
    gpu: &'g Gpu,
    pass: MeshPass,
    shadow: ShadowPass,
    minify: Minify,
    average: Average,
    environment: Environment,
}

impl<'g> Renderer<'g> {
    /// Builds the kernels and render passes.
    ///
    /// # Errors
    /// [`PipelineError::Gpu`] if the driver refuses one.
    pub fn new(gpu: &'g Gpu) -> Result<Self, PipelineError> {
        let (pass, shadow, minify, average) = (MeshPass::new(gpu)?, ShadowPass::new(gpu)?, Minify::new(gpu)?, Average::new(gpu)?);
        Ok(Self { gpu, pass, shadow, minify, average, environment: Environment::new(gpu)? })
    }

    /// Uploads what `view` shows of `material`, and draws the shadow maps.
    ///
    /// # Errors
    /// [`PipelineError::NoLpca`] if the material has no local PCA and it is asked for, [`PipelineError::Stage`] or [`PipelineError::Gpu`] if
    /// something does not fit the adapter.
    pub fn dress(&self, studio: &Studio<'_>, view: &MeshView, material: &Material, progress: &Progress) -> Result<Dressed, PipelineError> {
        let mut surface = studio.surface(material, progress)?;
        let compressed =
            view.unpainted.map(|texel_samples| Ok::<_, PipelineError>((studio.compressed(material)?, texel_samples))).transpose()?;
        let texels = material.size().iter().product();
        run(self.gpu, progress, "minify", [texels, 1], |recorder| Ok::<_, PipelineError>(self.minify.record(recorder, &mut surface)?))?;
        self.show(view, surface, compressed, progress)
    }

    /// Draws the shadow maps anew, of the lights of `view`; all else of `dressed` stays.
    ///
    /// # Errors
    /// [`PipelineError::Gpu`] if they do not fit the adapter.
    pub fn relight(&self, dressed: &mut Dressed, view: &MeshView, progress: &Progress) -> Result<(), PipelineError> {
        dressed.lighting = self.light(&dressed.mesh, view, &dressed.around, progress)?;
        if let Some(surroundings) = &view.surroundings {
            dressed.surroundings.turn_to(surroundings.turn);
        }
        Ok(())
    }

    fn light(&self, mesh: &MeshBuffers, view: &MeshView, around: &[Light], progress: &Progress) -> Result<Lighting, PipelineError> {
        let turn = DQuat::from_rotation_y(view.surroundings.as_ref().map_or(0.0, |surroundings| surroundings.turn));
        let around: Vec<_> = around.iter().map(|light| light.turned(turn)).collect();
        let lights = Lights { lights: &view.lights, around: &around, shadows: view.shadows };
        run(self.gpu, progress, "shadow", [0, 1], |recorder| Ok::<_, PipelineError>(self.shadow.record(recorder, mesh, lights)?))
    }

    /// As [`Self::dress`], of a surface that is uploaded.
    ///
    /// # Errors
    /// [`PipelineError::Gpu`] if something does not fit the adapter.
    pub fn show(
        &self, view: &MeshView, surface: Surface, compressed: Option<(CompressedBtf, TexelSamples)>, progress: &Progress,
    ) -> Result<Dressed, PipelineError> {
        let mesh = MeshBuffers::upload(self.gpu, &view.mesh, view.tiling)?;
        let (surroundings, around) = self.surround(view.surroundings.as_ref(), progress)?;
        let lighting = self.light(&mesh, view, &around, progress)?;
        let MeshView { relief, silhouette, sampling, .. } = *view;
        Ok(Dressed { mesh, surface, compressed, lighting, surroundings, around, relief, silhouette, sampling })
    }

    /// An environment, prefiltered, and the lights that stand for it.
    fn surround(&self, around: Option<&Surroundings>, progress: &Progress) -> Result<(SurroundingsBuffers, Vec<Light>), PipelineError> {
        let Some(Surroundings { environment, strength, turn }) = around else {
            let mut recorder = self.gpu.recorder();
            let none = SurroundingsBuffers::none(&mut recorder)?;
            self.gpu.submit(recorder).wait(self.gpu)?;
            return Ok((none, Vec::new()));
        };
        let [columns, rows] = ENVIRONMENT_SOURCE;
        let texels = columns * rows;
        let (source, levels, albedo) = run(self.gpu, progress, "environment", [texels, 1], |recorder| {
            let source = self.environment.record_source(recorder, environment)?;
            let levels = self.environment.record(recorder, environment, ENVIRONMENT_SIZE)?;
            Ok::<_, PipelineError>((source, levels, self.environment.record_albedo(recorder)?))
        })?;
        let radiance = source.read(self.gpu)?.into_iter().map(|[r, g, b, _]| [r, g, b]).collect();
        let source = data::Environment::new(Map::new(columns, rows, radiance)?)?;
        let lights = source.lights(AROUND).into_iter().map(|light| light.brighter(*strength)).collect();
        let albedo = albedo.read(self.gpu)?;
        let mut recorder = self.gpu.recorder();
        let buffers = SurroundingsBuffers::record(&mut recorder, &levels, &albedo, *strength, *turn)?;
        self.gpu.submit(recorder).wait(self.gpu)?;
        Ok((buffers, lights))
    }

    /// What `channels` tell of `dressed`, seen by `camera`, by the names of their layers in a file, `[row][column]` each, 0 where nothing is.
    /// `material` is what it wears.
    ///
    /// # Errors
    /// As [`Self::picture`].
    pub fn channels(
        &self, dressed: &Dressed, camera: &Camera, material: &Material, channels: &[Channel], progress: &Progress,
    ) -> Result<Vec<(&'static str, Vec<f32>)>, PipelineError> {
        let asked = |of: &[Channel]| of.iter().any(|channel| channels.contains(channel));
        let draw = |output| self.picture(dressed, camera, output, progress);
        let geometry = asked(&[Channel::Depth, Channel::Normal]).then(|| draw(Output::Geometry)).transpose()?;
        let paint = asked(&[Channel::Painted, Channel::Thickness, Channel::Texel]).then(|| draw(Output::Paint)).transpose()?;
        let component =
            |of: &Option<Map<[f32; 4]>>, index: usize| of.iter().flat_map(|map| map.values()).map(|value| value[index]).collect::<Vec<_>>();
        let thickness = |value: &[f32; 4]| match &material.painted {
            Some(painted) => {
                #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a texel's column and row")]
                let at = (value[2] as usize, value[3] as usize);
                painted.height[at] - material.height[at]
            }
            None => 0.0,
        };
        let mut all = Vec::new();
        for channel in channels {
            let values = match channel {
                Channel::Depth => vec![component(&geometry, 3)],
                Channel::Normal => vec![component(&geometry, 0), component(&geometry, 1), component(&geometry, 2)],
                Channel::Painted => vec![component(&paint, 0)],
                Channel::Thickness => vec![paint.iter().flat_map(|map| map.values()).map(thickness).collect()],
                Channel::Texel => vec![component(&paint, 2), component(&paint, 3)],
            };
            all.extend(channel.layers().iter().copied().zip(values));
        }
        Ok(all)
    }

    /// What `camera` sees of `dressed`, `[row][column]`: R, G, B in reflectance units times coverage, and coverage.
    ///
    /// # Errors
    /// [`PipelineError::Gpu`] if it does not fit the adapter.
    pub fn radiance(&self, dressed: &Dressed, camera: &Camera, progress: &Progress) -> Result<Map<[f32; 4]>, PipelineError> {
        self.picture(dressed, camera, Output::Radiance, progress)
    }

    /// What `output` says of `dressed`, seen by `camera`, `[row][column]`, 0 where nothing is. Of a radiance it is the mean of as many
    /// pictures as its view asks for; directions, distances and texels, which have no mean, are those in the middle of each pixel.
    ///
    /// # Errors
    /// [`PipelineError::Gpu`] if it does not fit the adapter.
    pub fn picture(&self, dressed: &Dressed, camera: &Camera, output: Output, progress: &Progress) -> Result<Map<[f32; 4]>, PipelineError> {
        let sampling = if output == Output::Radiance { dressed.sampling } else { Sampling { pictures: 1, ..dressed.sampling } };
        let [width, height] = camera.size;
        let mut picture = Map::from_fn(width as usize, height as usize, |_, _| [0.0; 4]);
        for (top, left) in (0..height).step_by(TILE as usize).flat_map(|top| (0..width).step_by(TILE as usize).map(move |left| (top, left)))
        {
            let size = [TILE.min(width - left), TILE.min(height - top)];
            let pixels = size[0] as usize * size[1] as usize;
            let target = MeshTarget::new(self.gpu, size)?;
            let mean = self.gpu.fresh("mean picture", pixels)?;
            let shown = Shown { sampling, ..dressed.shown() };
            for sample in 0..sampling.pictures {
                let [right, down] = within_pixel(sample, sampling.pictures);
                let window = Window { corner: [f64::from(left) + right, f64::from(top) + down], size: size.map(f64::from) };
                run(self.gpu, progress, "mesh_hit", [pixels, 1], |recorder| {
                    Ok::<_, PipelineError>(self.pass.hit(recorder, shown, camera, window, &target)?)
                })?;
                run(self.gpu, progress, "mesh", [pixels, 1], |recorder| {
                    self.pass.shade(recorder, shown, camera, window, output, &target)?;
                    let drawn = target.picture.record_copy(recorder)?;
                    self.average.record(
                        recorder,
                        &drawn,
                        &mean,
                        [size[0] as usize, target.picture.row_pixels()],
                        [sample, sampling.pictures],
                    )
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
