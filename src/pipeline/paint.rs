//! Laying a recipe's paint on a material.
//!
//! A painted material is a material again: its height, reflectance and local PCA stay what was measured, and the paint is beside them,
//! already on its ground. So a picture of it is the same whether the paint was stored or laid on the way.

use super::{PipelineError, Progress, tiles::run};
use crate::{
    data::{Map, Material, Painted, Recipe},
    gpu::{Buffer, Gpu, GpuError, Recorder},
    model::{Layer, PaintMethod, Pattern},
    stage::{self, PaintStack},
};

/// The stages that paint, on one device.
#[derive(Debug)]
pub struct Painter<'g> {
    gpu: &'g Gpu,
    pattern: stage::Pattern,
    pattern_image: stage::PatternImage,
    kubelka_munk: stage::KubelkaMunk,
    alpha_blend: stage::AlphaBlend,
    normals: stage::Normals,
}

impl<'g> Painter<'g> {
    /// Builds the kernels.
    ///
    /// # Errors
    /// [`PipelineError::Gpu`] if the driver refuses one.
    pub fn new(gpu: &'g Gpu) -> Result<Self, PipelineError> {
        Ok(Self {
            gpu,
            pattern: stage::Pattern::new(gpu)?,
            pattern_image: stage::PatternImage::new(gpu)?,
            kubelka_munk: stage::KubelkaMunk::new(gpu)?,
            alpha_blend: stage::AlphaBlend::new(gpu)?,
            normals: stage::Normals::new(gpu)?,
        })
    }

    /// `material`, as many pieces of it as the recipe says, under the layers of `recipe`; paint that is already there is painted over.
    ///
    /// # Errors
    /// [`PipelineError::Paint`] or [`PipelineError::Pattern`] if a setting of a layer is out of range, [`PipelineError::NoSuchImage`] if a
    /// pattern names an image that the recipe does not have, [`PipelineError::PlaneTooLarge`] if there are too many pieces,
    /// [`PipelineError::MethodsDiffer`] if the paint on the material was laid in the other way, [`PipelineError::Gpu`] if a map does not fit
    /// the adapter.
    pub fn paint(&self, material: &Material, recipe: &Recipe, method: PaintMethod, progress: &Progress) -> Result<Material, PipelineError> {
        for layer in &recipe.layers {
            layer.clone().checked()?;
            layer.pattern.checked()?;
            layer.placement.checked()?;
        }
        let [pieces_right, pieces_down] = recipe.repeat;
        let [width, height] = material.size();
        let texels = [width, height, pieces_right, pieces_down].into_iter().try_fold(1_usize, usize::checked_mul);
        // Reflectance and coverage are the largest array; asked before the host holds as much of every map.
        let limit = usize::try_from(self.gpu.max_array_bytes()).unwrap_or(usize::MAX) / size_of::<[f32; 4]>();
        if texels.is_none_or(|texels| texels == 0 || texels > limit) {
            let adapter = self.gpu.adapter().name.clone();
            return Err(PipelineError::PlaneTooLarge { size: [width, height], repeat: recipe.repeat, adapter, limit });
        }
        if let Some(before) = material.painted.as_ref().map(|painted| painted.method).filter(|&before| before != method) {
            return Err(PipelineError::MethodsDiffer { before, asked: method });
        }
        let ground = material.repeated(pieces_right, pieces_down);
        let painted = self.lay(&ground, recipe, method, progress)?;
        Ok(Material { painted: Some(painted), ..ground }.checked()?)
    }

    /// The paint of `recipe` on `ground`.
    fn lay(&self, ground: &Material, recipe: &Recipe, method: PaintMethod, progress: &Progress) -> Result<Painted, PipelineError> {
        let gpu = self.gpu;
        let [columns, rows] = ground.size();
        let (size, texels) = ([stage::count(columns), stage::count(rows)], columns * rows);
        let heights = ground.painted.as_ref().map_or(&ground.height, |painted| &painted.height);
        let heights = gpu.upload("height", heights.values())?;
        let (painted, coats) = (upload_painted(gpu, ground)?, upload_coats(gpu, ground)?);

        // As many layers at a time as one binding holds drawn thicknesses of.
        let layer_bytes = (texels * size_of::<f32>()) as u64;
        let batch = usize::try_from(gpu.max_array_bytes() / layer_bytes).unwrap_or(usize::MAX).clamp(1, recipe.layers.len().max(1));
        let drawn = gpu.fresh("drawn", batch * texels)?;
        let mut stack = PaintStack::new(gpu, painted, coats, heights, recipe.layers.len(), batch)?;
        for layers in recipe.layers.chunks(batch) {
            for (index, layer) in layers.iter().enumerate() {
                run(gpu, progress, "pattern", [texels, 1], |recorder| self.draw(recorder, layer, recipe, size, &drawn, index))?;
            }
            match method {
                PaintMethod::KubelkaMunk => run(gpu, progress, "kubelka_munk", [texels, 1], |recorder| {
                    self.kubelka_munk.record(recorder, &mut stack, &drawn, layers)
                })?,
                PaintMethod::AlphaBlend => {
                    run(gpu, progress, "alpha_blend", [texels, 1], |recorder| {
                        self.alpha_blend.record(recorder, &stack.painted, &drawn, layers)
                    })?;
                }
            }
        }
        let boundary = ground.provenance.settings.boundary;
        let normals = run(gpu, progress, "normals", [texels, 1], |recorder| self.normals.record(recorder, &stack.heights, size, boundary))?;

        let map = |values: Vec<f32>| Map::new(columns, rows, values);
        let painted = Map::new(columns, rows, stack.painted.read(gpu)?)?;
        let (mut layers, mut images) =
            ground.painted.as_ref().map_or_else(Default::default, |painted| (painted.layers.clone(), painted.images.clone()));
        let first_image = images.len();
        images.extend(recipe.images.iter().map(|image| image.name.clone()));
        layers.extend(recipe.layers.iter().map(|layer| match layer.pattern {
            Pattern::Image { image } => Layer { pattern: Pattern::Image { image: first_image + image }, ..layer.clone() },
            _ => layer.clone(),
        }));
        Ok(Painted {
            method,
            layers,
            images,
            height: map(stack.heights.read(gpu)?)?,
            normal: Map::new(columns, rows, normals.read(gpu)?.into_iter().map(|[x, y, z, _]| [x, y, z]).collect())?,
            reflectance: painted.map(|&[r, g, b, _]| [r, g, b]),
            coverage: painted.map(|&[.., coverage]| coverage),
            coat: Map::new(columns, rows, stack.coats.read(gpu)?)?,
        })
    }

    /// Draws the pattern of `layer` as number `index` of `drawn`.
    fn draw(
        &self, recorder: &mut Recorder<'_>, layer: &Layer, recipe: &Recipe, size: [u32; 2], drawn: &Buffer<f32>, index: usize,
    ) -> Result<(), PipelineError> {
        match layer.pattern {
            Pattern::Image { image } => {
                let found = recipe.images.get(image).ok_or(PipelineError::NoSuchImage { image, images: recipe.images.len() })?;
                self.pattern_image.record(recorder, &found.drawn, layer.placement, size, drawn, index)?;
            }
            pattern => self.pattern.record(recorder, pattern, layer.placement, size, drawn, index)?,
        }
        Ok(())
    }
}

/// Reflectance of the paint on `material`, and coverage; where there is none the bare material's, and 0.
pub(super) fn upload_painted(gpu: &Gpu, material: &Material) -> Result<Buffer<[f32; 4]>, GpuError> {
    let texels: Vec<_> = match &material.painted {
        None => material.svbrdf.diffuse.values().iter().map(|&[r, g, b]| [r, g, b, 0.0]).collect(),
        Some(Painted { reflectance, coverage, .. }) => {
            reflectance.values().iter().zip(coverage.values()).map(|(&[r, g, b], &coverage)| [r, g, b, coverage]).collect()
        }
    };
    gpu.upload("painted", &texels)
}

/// Surfaces of the paint on `material`; 0 where there is none.
pub(super) fn upload_coats(gpu: &Gpu, material: &Material) -> Result<Buffer<[f32; 2]>, GpuError> {
    match &material.painted {
        None => gpu.zeros("coats", material.svbrdf.diffuse.values().len()),
        Some(painted) => gpu.upload("coats", painted.coat.values()),
    }
}
