//! Pictures of a material, bare or painted.

use super::{
    PipelineError, Progress,
    paint::{upload_coats, upload_painted},
    tiles::run,
};
use crate::{
    data::{Direction, Map, Material, PlaneView},
    gpu::{Buffer, Gpu, GpuError, Recorder},
    model::{Appearance, Relief, TexelSamples},
    render::Plane,
    stage::{self, CompressedBtf, HeightField, Surface},
};

/// What a studio takes pictures of, in adapter memory.
#[derive(Debug)]
pub enum Subject {
    /// A material's reflectance on its height field.
    Surface {
        /// Its maps.
        surface: Box<Surface>,
        /// Which effects of the height field the pictures have.
        relief: Relief,
    },
    /// A material's local PCA.
    Compressed {
        /// Its arrays.
        btf: Box<CompressedBtf>,
        /// How the pictures are interpolated between texels.
        texel_samples: TexelSamples,
    },
}

impl Subject {
    /// Columns and rows of the texel plane.
    fn size(&self) -> [usize; 2] {
        match self {
            Self::Surface { surface, .. } => surface.field.size,
            Self::Compressed { btf, .. } => btf.size(),
        }
        .map(|texels| texels as usize)
    }
}

/// The stages that make pictures, on one device.
#[derive(Debug)]
pub struct Studio<'g> {
    gpu: &'g Gpu,
    normals: stage::Normals,
    reconstruct: stage::Reconstruct,
    reconstruct_lpca: stage::ReconstructLpca,
    plane: Plane,
}

impl<'g> Studio<'g> {
    /// Builds the kernels and render passes.
    ///
    /// # Errors
    /// [`PipelineError::Gpu`] if the driver refuses one.
    pub fn new(gpu: &'g Gpu) -> Result<Self, PipelineError> {
        Ok(Self {
            gpu,
            normals: stage::Normals::new(gpu)?,
            reconstruct: stage::Reconstruct::new(gpu)?,
            reconstruct_lpca: stage::ReconstructLpca::new(gpu)?,
            plane: Plane::new(gpu)?,
        })
    }

    /// The maps that pictures are made from, its paint included.
    ///
    /// # Errors
    /// [`PipelineError::Gpu`] if a map does not fit the adapter.
    pub fn surface(&self, material: &Material, progress: &Progress) -> Result<Surface, PipelineError> {
        let gpu = self.gpu;
        let [columns, rows] = material.size();
        let (size, texels) = ([stage::count(columns), stage::count(rows)], columns * rows);
        let boundary = material.provenance.settings.boundary;
        let height = material.painted.as_ref().map_or(&material.height, |painted| &painted.height);
        let heights = gpu.upload("height", height.values())?;
        let normals = run(gpu, progress, "normals", [texels, 1], |recorder| self.normals.record(recorder, &heights, size, boundary))?;
        let range = height.values().iter().fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], &z| [low.min(z), high.max(z)]);
        let lobes = &material.svbrdf.lobes;
        let specular: Vec<_> = lobes.iter().flat_map(|lobe| lobe.specular.values()).map(|&[r, g, b]| [r, g, b, 0.0]).collect();
        let parameters: Vec<_> = lobes.iter().flat_map(|lobe| lobe.parameters.values()).copied().collect();
        Ok(Surface {
            field: HeightField { size, heights, normals, range, boundary },
            frame: material.svbrdf.frame,
            ambient: material.svbrdf.ambient,
            diffuse: upload_rgb(gpu, "diffuse", &material.svbrdf.diffuse)?,
            specular: gpu.upload("specular", &specular)?,
            lobes: gpu.upload("lobes", &parameters)?,
            levels: 1,
            painted: upload_painted(gpu, material)?,
            coats: upload_coats(gpu, material)?,
            method: material.painted.as_ref().map(|painted| painted.method).unwrap_or_default(),
        })
    }

    /// The image that the source would have recorded from `view` under `light`: one pixel a texel on the base plane, linear
    /// RGBA in reflectance units, `[row][column]`.
    ///
    /// # Errors
    /// [`PipelineError::Gpu`] if the picture does not fit the adapter.
    pub fn reconstruct(
        &self, surface: &Surface, view: Direction, light: Direction, relief: Relief, progress: &Progress,
    ) -> Result<Map<[f32; 4]>, PipelineError> {
        let [width, height] = surface.field.size.map(|texels| texels as usize);
        let picture = run(self.gpu, progress, "reconstruct", [width * height, 1], |recorder| {
            self.reconstruct.record(recorder, surface, view, light, relief)
        })?;
        Ok(Map::new(width, height, picture.read(self.gpu)?)?)
    }

    /// The part of a material that `appearance` names; its local PCA is that of the bare one.
    ///
    /// # Errors
    /// [`PipelineError::NoLpca`] if the material has no local PCA and it was asked for, [`PipelineError::Stage`] or [`PipelineError::Gpu`] if
    /// it does not fit the adapter.
    pub fn subject(&self, material: &Material, appearance: Appearance, progress: &Progress) -> Result<Subject, PipelineError> {
        match appearance {
            Appearance::Svbrdf { relief } => Ok(Subject::Surface { surface: Box::new(self.surface(material, progress)?), relief }),
            Appearance::Lpca { texel_samples } => Ok(Subject::Compressed { btf: Box::new(self.compressed(material)?), texel_samples }),
        }
    }

    /// A material's local PCA, in adapter memory.
    ///
    /// # Errors
    /// [`PipelineError::NoLpca`] if it has none, [`PipelineError::Stage`] or [`PipelineError::Gpu`] if it does not fit the adapter.
    pub fn compressed(&self, material: &Material) -> Result<CompressedBtf, PipelineError> {
        let provenance = &material.provenance;
        let lpca = material.lpca.as_ref().ok_or_else(|| PipelineError::NoLpca { source_name: provenance.source.clone() })?;
        Ok(CompressedBtf::upload(self.gpu, lpca, &provenance.views, &provenance.lights, provenance.settings.boundary)?)
    }

    /// As [`Self::reconstruct`], of either part of a material.
    ///
    /// # Errors
    /// [`PipelineError::Gpu`] if the picture does not fit the adapter.
    pub fn picture(
        &self, subject: &Subject, view: Direction, light: Direction, progress: &Progress,
    ) -> Result<Map<[f32; 4]>, PipelineError> {
        let [width, height] = subject.size();
        let picture = run(self.gpu, progress, "reconstruct", [width * height, 1], |recorder| {
            let picture = self.gpu.fresh("reconstructed picture", width * height)?;
            self.record_picture(recorder, subject, view, light, &picture)?;
            Ok::<_, GpuError>(picture)
        })?;
        Ok(Map::new(width, height, picture.read(self.gpu)?)?)
    }

    /// `count` pictures side by side, view and light in even steps from those of `start` to those of `end`.
    ///
    /// # Errors
    /// As [`Self::picture`].
    pub fn strip(
        &self, subject: &Subject, start: [Direction; 2], end: [Direction; 2], count: usize, progress: &Progress,
    ) -> Result<Map<[f32; 4]>, PipelineError> {
        #[expect(clippy::cast_precision_loss, reason = "a few pictures")]
        let part = |index: usize| index as f64 / count.saturating_sub(1).max(1) as f64;
        let pictures = (0..count).map(|index| {
            let [view, light] = [0, 1].map(|of| start[of].toward(end[of], part(index)));
            self.picture(subject, view, light, progress)
        });
        let pictures = pictures.collect::<Result<Vec<_>, _>>()?;
        let [width, height] = subject.size();
        Ok(Map::from_fn(count * width, height, |column, row| pictures[column / width][(column % width, row)]))
    }

    /// The picture behind [`Self::picture`], for those that record many at once.
    pub(super) fn record_picture(
        &self, recorder: &mut Recorder<'_>, subject: &Subject, view: Direction, light: Direction, picture: &Buffer<[f32; 4]>,
    ) -> Result<(), GpuError> {
        match subject {
            Subject::Surface { surface, relief } => self.reconstruct.record_into(recorder, surface, view, light, *relief, picture),
            Subject::Compressed { btf, texel_samples } => {
                self.reconstruct_lpca.record_into(recorder, btf, *texel_samples, view, light, picture)
            }
        }
    }

    /// The device.
    pub(super) fn gpu(&self) -> &'g Gpu {
        self.gpu
    }

    /// The material as a plane in space: linear RGBA, premultiplied, `[row][column]`.
    ///
    /// # Errors
    /// [`PipelineError::Gpu`] if the picture does not fit the adapter.
    pub fn render(&self, surface: &Surface, shot: &PlaneView, relief: Relief, progress: &Progress) -> Result<Map<[f32; 4]>, PipelineError> {
        let [width, height] = shot.size.map(|pixels| pixels as usize);
        let (target, padded) = run(self.gpu, progress, "plane", [width * height, 1], |recorder| {
            let target = self.plane.draw(recorder, surface, shot, relief)?;
            let padded = target.record_copy(recorder)?;
            Ok::<_, PipelineError>((target, padded))
        })?;
        Ok(Map::new(width, height, target.unpad(&padded.read(self.gpu)?))?)
    }
}

/// A colour map with a fourth component of 0.
fn upload_rgb(gpu: &Gpu, label: &str, map: &Map<[f32; 3]>) -> Result<Buffer<[f32; 4]>, PipelineError> {
    let texels: Vec<[f32; 4]> = map.values().iter().map(|&[r, g, b]| [r, g, b, 0.0]).collect();
    Ok(gpu.upload(label, &texels)?)
}
