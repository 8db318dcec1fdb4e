//! The figures of the thesis on models: what the bare part is made from, patterns, refractive indices, thickness and layers of paint.

use super::{
    PipelineError, Renderer,
    figures::Job,
    report::{Cell, Figure, Report, Row},
};
use crate::{
    data::{Camera, Light, Map, Mesh, MeshView, Recipe, Sampling, Shape},
    model::{Development, Layer, Paint, PaintMethod, Pattern, TexelSamples, pigments},
};

/// Azimuth and elevation, degrees, of the cameras of two columns of figs. 4.7 and 4.8.
const BEARINGS: [[f64; 2]; 2] = [[30.0, 35.0], [-50.0, 10.0]];
/// Height of paint of thickness 1, texel widths.
const RELIEF: f64 = 0.5;
/// GGX α of paint whose refractive index shows.
const GLOSSY: f64 = 0.15;
/// Refractive indices of figs. 4.9 to 4.12.
const INDICES: [f64; 3] = [1.8, 2.0, 2.2];

/// A pattern and paints of figs. 4.9 to 4.12, each with its thickness.
type Patterned = (&'static str, &'static str, Pattern, [(&'static str, f64); 3]);

const PATTERNED: [Patterned; 4] = [
    ("4.9", "Watercolour splashes", Pattern::Splash { seed: 3 }, WATERCOLOURS),
    ("4.10", "Oil splashes", Pattern::Splash { seed: 5 }, OILS),
    ("4.11", "Watercolour flowers", Pattern::Flower { seed: 2, petals: 6 }, WATERCOLOURS),
    ("4.12", "Oil flowers", Pattern::Flower { seed: 4, petals: 8 }, OILS),
];
const WATERCOLOURS: [(&str, f64); 3] =
    [("watercolour/quinacridone rose", 1.0), ("watercolour/cerulean blue", 1.5), ("watercolour/cadmium yellow", 1.0)];
const OILS: [(&str, f64); 3] = [("oil/alizarin crimson", 1.0), ("oil/sap green", 1.5), ("oil/cadmium yellow", 1.0)];

/// Paints of figs. 4.13 and 4.14, with their thickness.
const BRUSHED: [(&str, &str, &str, f64); 2] = [
    ("4.13", "Watercolour brushed on, once to three times as thick", "watercolour/french ultramarine", 0.5),
    ("4.14", "Oil brushed on, once to three times as thick", "oil/cobalt blue", 3.0),
];

/// The layers of figs. 4.15 and 4.16, from the bottom up.
const LAYERS: [(&str, f64, Pattern); 4] = [
    ("oil/cobalt blue", 6.0, Pattern::Brush { seed: 2, width: 0.4 }),
    ("oil/alizarin crimson", 1.5, Pattern::Splash { seed: 3 }),
    ("oil/burnt sienna", 1.5, Pattern::Spatter { seed: 4, cover: 0.25 }),
    ("oil/viridian", 1.5, Pattern::Flower { seed: 1, petals: 6 }),
];

/// Figures of one material on models.
pub(super) struct OnMeshes<'a> {
    pub job: &'a Job<'a>,
    pub renderer: &'a Renderer<'a>,
    pub models: &'a [(String, Mesh)],
}

impl OnMeshes<'_> {
    /// `own` models and, after them, the built-in ones.
    pub(super) fn models(own: Vec<(String, Mesh)>) -> Vec<(String, Mesh)> {
        let built_in = [Shape::Cloth, Shape::TorusKnot, Shape::Sphere].map(|shape| (shape.name().to_owned(), shape.mesh()));
        own.into_iter().chain(built_in).collect()
    }

    /// All figures, in order.
    pub(super) fn figures(&self, report: &mut Report<'_>) -> Result<(), PipelineError> {
        for (index, (number, title, paint, thickness, pattern)) in [
            (
                "4.7",
                "What is bare under watercolour: local PCA and reflectance",
                "watercolour/cerulean blue",
                1.5,
                Pattern::Splash { seed: 3 },
            ),
            ("4.8", "What is bare under oil: local PCA and reflectance", "oil/cadmium yellow", 1.0, Pattern::Flower { seed: 4, petals: 6 }),
        ]
        .into_iter()
        .enumerate()
        {
            let layer = Layer { pattern, ..layer(paint, thickness)? };
            report.figure(&self.unpainted(number, title, layer, index)?)?;
        }
        for (index, (number, title, pattern, paints)) in PATTERNED.into_iter().enumerate() {
            report.figure(&self.patterned(number, title, pattern, &paints, index)?)?;
        }
        for (number, title, paint, thickness) in BRUSHED {
            report.figure(&self.brushed(number, title, paint, thickness)?)?;
        }
        for (index, number) in ["4.15", "4.16"].into_iter().enumerate() {
            report.figure(&self.layered(number, index)?)?;
        }
        Ok(())
    }

    /// Thesis figs. 4.7 and 4.8.
    fn unpainted(&self, number: &str, title: &str, layer: Layer, model: usize) -> Result<Figure, PipelineError> {
        let (name, mesh) = self.model(model);
        let mut rows = Vec::new();
        let ways: [(&str, Option<TexelSamples>); 2] = [("local PCA", Some(TexelSamples::default())), ("reflectance", None)];
        for (label, unpainted) in ways.into_iter().filter(|(_, way)| way.is_none() || self.job.material.lpca.is_some()) {
            let mut cells = Vec::new();
            for layers in [vec![], vec![layer.clone()]] {
                let pictures = self.pictures(layers, mesh, &BEARINGS, unpainted)?;
                cells.extend(pictures.into_iter().map(|picture| Cell { picture, note: String::new() }));
            }
            rows.push(Row { label: label.to_owned(), cells });
        }
        let caption = format!(
            "{}, on the model \"{name}\". Above, what is bare is looked up in the original, compressed by local PCA, where a ray crosses the base \
             plane: it has the original's parallax, shadows and light by way of others. Below, it is made from the recovered reflectance on the \
             recovered height. What is painted is the same in both.",
            self.job.name
        );
        Ok(self.job.figure(number, title, caption, ["bare", "bare", "painted", "painted"].map(String::from).to_vec(), rows))
    }

    /// Thesis figs. 4.9 to 4.12.
    fn patterned(
        &self, number: &str, title: &str, pattern: Pattern, paints: &[(&str, f64)], model: usize,
    ) -> Result<Figure, PipelineError> {
        let (name, mesh) = self.model(model);
        let mut rows = Vec::new();
        for (paint, thickness) in paints {
            let mut cells = Vec::new();
            for refractive_index in INDICES {
                let layer = Layer { pattern, refractive_index, roughness: GLOSSY, ..layer(paint, *thickness)? };
                cells.push(Cell { picture: self.bare_as_original(vec![layer], mesh)?, note: String::new() });
            }
            rows.push(Row { label: (*paint).to_owned(), cells });
        }
        let caption = format!(
            "{}, on the model \"{name}\". The paint's surface mirrors more of the light the higher its refractive index is, and lets less of it \
             into the paint: highlights gain, colours lose.",
            self.job.name
        );
        let columns = INDICES.map(|index| format!("refractive index {index:.1}")).to_vec();
        Ok(self.job.figure(number, title, caption, columns, rows))
    }

    /// Thesis figs. 4.13 and 4.14.
    fn brushed(&self, number: &str, title: &str, paint: &str, thickness: f64) -> Result<Figure, PipelineError> {
        let mut rows = Vec::new();
        for (name, mesh) in self.models.iter().take(2) {
            let mut cells = Vec::new();
            for times in [1.0, 2.0, 3.0] {
                let layer = Layer { pattern: Pattern::Brush { seed: 3, width: 0.45 }, ..layer(paint, times * thickness)? };
                cells.push(Cell { picture: self.bare_as_original(vec![layer], mesh)?, note: format!("thickness {}", times * thickness) });
            }
            rows.push(Row { label: name.clone(), cells });
        }
        let caption = format!(
            "{}; {paint}. The thicker the stroke, the more it hides and the higher the ridges that its bristles leave.",
            self.job.name
        );
        Ok(self.job.figure(number, title, caption, ["× 1", "× 2", "× 3"].map(String::from).to_vec(), rows))
    }

    /// Thesis figs. 4.15 and 4.16.
    fn layered(&self, number: &str, model: usize) -> Result<Figure, PipelineError> {
        let (name, mesh) = self.model(model);
        let layers = LAYERS.iter().map(|(paint, thickness, pattern)| Ok(Layer { pattern: *pattern, ..layer(paint, *thickness)? }));
        let layers = layers.collect::<Result<Vec<_>, PipelineError>>()?;
        let mut cells = Vec::new();
        for count in 1..=layers.len() {
            cells.push(Cell { picture: self.bare_as_original(layers[..count].to_vec(), mesh)?, note: LAYERS[count - 1].0.to_owned() });
        }
        let caption = format!(
            "{}, on the model \"{name}\". Each layer lies on those before it and takes colour from them, as far as it lets light through.",
            self.job.name
        );
        let columns = ["one layer", "two", "three", "four"].map(String::from).to_vec();
        Ok(self.job.figure(number, "Several layers", caption, columns, vec![Row { label: String::new(), cells }]))
    }

    fn model(&self, index: usize) -> (&str, &Mesh) {
        let (name, mesh) = &self.models[index % self.models.len()];
        (name, mesh)
    }

    /// A picture whose bare part is the original's, if it is there.
    fn bare_as_original(&self, layers: Vec<Layer>, mesh: &Mesh) -> Result<Map<[f32; 4]>, PipelineError> {
        let unpainted = self.job.material.lpca.is_some().then(TexelSamples::default);
        Ok(self.pictures(layers, mesh, &BEARINGS[..1], unpainted)?.swap_remove(0))
    }

    /// A picture from each of `bearings`.
    fn pictures(
        &self, layers: Vec<Layer>, mesh: &Mesh, bearings: &[[f64; 2]], unpainted: Option<TexelSamples>,
    ) -> Result<Vec<Map<[f32; 4]>>, PipelineError> {
        let Job { settings, material, studio, painter, progress, .. } = self.job;
        let repeat = material.size().map(|texels| settings.texels.div_ceil(texels));
        let painted = painter.paint(material, &Recipe { repeat, layers, images: Vec::new() }, PaintMethod::KubelkaMunk, progress)?;
        let camera = |bearing| Camera::showing(mesh, bearing, MeshView::ANGLE_OF_VIEW, [settings.side; 2], false);
        let view = MeshView {
            unpainted,
            sampling: Sampling { pictures: settings.rays, ..Sampling::default() },
            ..MeshView::new(mesh.clone(), camera(bearings[0]), Light::pair())
        };
        let dressed = self.renderer.dress(studio, &view, &painted, progress)?;
        let seen = |&bearing: &[f64; 2]| {
            let picture = self.renderer.radiance(&dressed, &camera(bearing), progress)?;
            Ok(picture.map(|&pixel| Development::default().develop(pixel)))
        };
        bearings.iter().map(seen).collect()
    }
}

/// A layer of the library's paint `name`.
fn layer(name: &str, thickness: f64) -> Result<Layer, PipelineError> {
    Ok(Layer::new(Paint::from(pigments::find(name)?), thickness, RELIEF * thickness))
}
