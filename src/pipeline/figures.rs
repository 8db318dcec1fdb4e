//! The figures of the thesis, on any material: what was measured and recovered, whole samples under paint, paint against alpha blending, and
//! painted models ([`figures_on_meshes`](super::figures_on_meshes)).

use std::path::Path;

use super::{
    Painter, PipelineError, Progress, Renderer, Studio, demo,
    figures_on_meshes::OnMeshes,
    measured::Measured,
    report::{Cell, Figure, Report, Row},
};
use crate::{
    data::{Direction, Map, Material, Mesh, PlaneView, Recipe},
    gpu::Gpu,
    io::Source,
    model::{Layer, Paint, PaintMethod, Pattern, Relief, pigments},
};

/// Name of the page in the folder of the figures.
pub const FIGURES: &str = "figures.html";

/// Three paints, each at two thicknesses.
type Paints = [(&'static str, [f64; 2]); 3];

/// Whole samples under one paint: figure of the thesis, title, and the paints with their thicknesses.
const WHOLE: [(&str, &str, Paints); 2] = [
    (
        "4.3",
        "Watercolour on the whole sample",
        [
            ("watercolour/quinacridone rose", [0.2, 0.4]),
            ("watercolour/cerulean blue", [0.2, 0.4]),
            ("watercolour/cadmium yellow", [0.2, 0.3]),
        ],
    ),
    (
        "4.4",
        "Oil on the whole sample",
        [("oil/alizarin crimson", [0.04, 0.2]), ("oil/sap green", [0.1, 0.4]), ("oil/cadmium yellow", [0.04, 0.08])],
    ),
];

/// Paint against alpha blending: figure, title, paint and its thickness where it is drawn in full.
const BLENDED: [(&str, &str, &str, f64); 2] = [
    ("4.5", "Watercolour and alpha blending", "watercolour/cerulean blue", 1.6),
    ("4.6", "Oil and alpha blending", "oil/cadmium yellow", 1.6),
];
/// Drawn thicknesses, which alpha blending takes for opacities.
const DRAWN: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

/// Texel widths by which paint of thickness 1 rises: enough to round the edges off that it fills, and no more.
const RELIEF: f64 = 0.1;
/// (θ, φ) in degrees of the view and of the light, which comes in low from the other side.
const VIEW: (f64, f64) = (30.0, 270.0);
const LIGHT: (f64, f64) = (55.0, 110.0);
/// Texels that are shown along each edge at least: smaller samples lie side by side.
const LEAST_TEXELS: usize = 64;

/// How large and how fine the pictures are.
#[derive(Debug, Clone, Copy)]
pub struct FigureSettings {
    /// Columns, and rows of a model's pictures; a plane's have fewer.
    pub side: u32,
    /// Rays a pixel of models.
    pub rays: u32,
    /// Texels along each edge of a model's painted plane, at least: smaller samples lie side by side.
    pub texels: usize,
}

impl Default for FigureSettings {
    /// 384 columns, four rays, 256 texels.
    fn default() -> Self {
        Self { side: 384, rays: 4, texels: 256 }
    }
}

/// A material to make figures of.
#[derive(Debug)]
pub struct Pictured {
    /// What it goes by.
    pub name: String,
    /// It.
    pub material: Material,
    /// What it was recovered from, if it is at hand.
    pub source: Option<Box<dyn Source>>,
}

impl Pictured {
    /// The sample inside this program, which is fitted first.
    ///
    /// # Errors
    /// [`PipelineError`] if a stage fails.
    pub fn sample(gpu: &Gpu, progress: &Progress) -> Result<Self, PipelineError> {
        Ok(Self { name: demo::SAMPLE_NAME.to_owned(), material: demo::fit_sample(gpu, progress)?, source: Some(demo::sample()?) })
    }
}

/// Makes the figures of each of `materials`, on `models` beside the built-in ones, and writes them with their page into `folder`, which must
/// exist.
///
/// # Errors
/// [`PipelineError::Painted`] if a material is painted already, others if a stage fails or a file cannot be written.
pub fn figures(
    gpu: &Gpu, materials: &[Pictured], models: Vec<(String, Mesh)>, settings: FigureSettings, folder: &Path, progress: &Progress,
) -> Result<(), PipelineError> {
    if materials.iter().any(|pictured| pictured.material.painted.is_some()) {
        return Err(PipelineError::Painted);
    }
    for Pictured { material, source, .. } in materials {
        if let Some(btf) = source.as_ref().map(|source| source.btf()).filter(|btf| btf.size() != material.size()) {
            let (source_name, source_size) = (btf.name().to_owned(), btf.size());
            return Err(PipelineError::SizesDiffer { source_name, source_size, material_size: material.size() });
        }
    }
    let (studio, painter, renderer) = (Studio::new(gpu)?, Painter::new(gpu)?, Renderer::new(gpu)?);
    let models = OnMeshes::models(models);
    let introduction = format!(
        "Painted by overpaint {} on {}. View and light are given as θ from the normal and φ counter-clockwise from the right, in degrees.",
        env!("CARGO_PKG_VERSION"),
        gpu.adapter().name
    );
    let mut report = Report::new(folder, "Painted materials", &introduction);
    for (index, Pictured { name, material, source }) in materials.iter().enumerate() {
        // Names may be alike, and need not be fit for files or addresses.
        let plain: String = name.chars().filter(|letter| letter.is_ascii_alphanumeric() || "-_".contains(*letter)).collect();
        let stem = format!("{}_{plain}", index + 1);
        if let Some(source) = source {
            let measured = Measured { source: source.as_ref(), material, studio: &studio, progress };
            for (number, figure) in [("3.2", measured.recovered()?), ("4.1", measured.above()?), ("4.2", measured.oblique()?)] {
                let title = format!("{} (thesis fig. {number}): {name}", figure.title);
                report.figure(&Figure { stem: format!("{stem}_{}", number.replace('.', "_")), title, ..figure })?;
            }
        }
        let job = Job { settings, name, stem, material, studio: &studio, painter: &painter, progress };
        for (number, title, paints) in WHOLE {
            report.figure(&job.whole(number, title, &paints)?)?;
        }
        for (number, title, paint, thickness) in BLENDED {
            report.figure(&job.blended(number, title, paint, thickness)?)?;
        }
        let on_meshes = OnMeshes { job: &job, renderer: &renderer, models: &models };
        on_meshes.figures(&mut report)?;
    }
    report.finish(FIGURES, &progress.report())?;
    Ok(())
}

/// What the figures of one material are made from.
pub(super) struct Job<'a> {
    pub settings: FigureSettings,
    pub name: &'a str,
    /// What the names of its files begin with.
    stem: String,
    pub material: &'a Material,
    pub studio: &'a Studio<'a>,
    pub painter: &'a Painter<'a>,
    pub progress: &'a Progress,
}

impl Job<'_> {
    /// Thesis figs. 4.3 and 4.4: bare, and under each of `paints` at two thicknesses.
    fn whole(&self, number: &str, title: &str, paints: &[(&str, [f64; 2])]) -> Result<Figure, PipelineError> {
        let bare = self.picture(None)?;
        let mut rows = Vec::new();
        for (name, thicknesses) in paints {
            let mut cells = vec![Cell { picture: bare.clone(), note: "bare".to_owned() }];
            for thickness in thicknesses {
                let picture = self.picture(Some((layer(name, *thickness, 1.0)?, PaintMethod::KubelkaMunk)))?;
                cells.push(Cell { picture, note: format!("thickness {thickness}") });
            }
            rows.push(Row { label: (*name).to_owned(), cells });
        }
        let caption = format!(
            "{}; {}. The paint lies everywhere at the same thickness, in the unit of its set. A thin film takes colour from the light on its way to \
             the material and back, so that the material shows through; a thicker one hides it by what it scatters.",
            self.name,
            directions()
        );
        Ok(self.figure(number, title, caption, ["bare", "thin", "thicker"].map(String::from).to_vec(), rows))
    }

    /// Thesis figs. 4.5 and 4.6: one paint at four thicknesses, and its colour blended in at as many opacities.
    fn blended(&self, number: &str, title: &str, paint: &str, thickness: f64) -> Result<Figure, PipelineError> {
        let mut rows = Vec::new();
        for (method, label) in [(PaintMethod::KubelkaMunk, "Kubelka-Munk"), (PaintMethod::AlphaBlend, "alpha blending")] {
            let mut cells = Vec::new();
            for drawn in DRAWN {
                let picture = self.picture(Some((layer(paint, thickness, drawn)?, method)))?;
                let note = match method {
                    PaintMethod::KubelkaMunk => format!("thickness {:.2}", thickness * drawn),
                    PaintMethod::AlphaBlend => format!("opacity {drawn}"),
                };
                cells.push(Cell { picture, note });
            }
            rows.push(Row { label: label.to_owned(), cells });
        }
        let caption = format!(
            "{}; {paint}; {}. Above, the paint; below, its colour at the greatest thickness over white, mixed into the picture. Paint lies on the surface \
             and is shaded with it, has a highlight and lets its ground through by what it absorbs and scatters in each channel; a blended colour \
             knows neither surface nor light and ends as a flat area.",
            self.name,
            directions()
        );
        Ok(self.figure(number, title, caption, DRAWN.map(|drawn| format!("{} %", 100.0 * drawn)).to_vec(), rows))
    }

    /// A figure of this material by its number.
    pub fn figure(&self, number: &str, title: &str, caption: String, columns: Vec<String>, rows: Vec<Row>) -> Figure {
        let stem = format!("{}_{}", self.stem, number.replace('.', "_"));
        Figure { stem, title: format!("{title} (thesis fig. {number}): {}", self.name), caption, columns, rows }
    }

    /// The sample as a plane in space, bare or under a layer.
    fn picture(&self, paint: Option<(Layer, PaintMethod)>) -> Result<Map<[f32; 4]>, PipelineError> {
        let repeat = self.material.size().map(|texels| LEAST_TEXELS.div_ceil(texels));
        let layers = paint.iter().map(|(layer, _)| layer.clone()).collect();
        let method = paint.map_or(PaintMethod::default(), |(_, method)| method);
        let recipe = Recipe { repeat, layers, images: Vec::new() };
        let material = self.painter.paint(self.material, &recipe, method, self.progress)?;
        let surface = self.studio.surface(&material, self.progress)?;
        let [view, light] = [VIEW, LIGHT].map(|(theta, phi)| Direction::from_degrees(theta, phi));
        self.studio.render(
            &surface,
            &PlaneView::new(view, light, [self.settings.side, self.settings.side * 9 / 10]),
            Relief::default(),
            self.progress,
        )
    }
}

fn directions() -> String {
    let [view, light] = [VIEW, LIGHT].map(|(theta, phi)| Direction::from_degrees(theta, phi));
    format!("view {view}, light {light}")
}

/// A layer of the library's paint `name`, drawn everywhere.
fn layer(name: &str, thickness: f64, drawn: f64) -> Result<Layer, PipelineError> {
    let pigment = pigments::find(name)?;
    Ok(Layer { pattern: Pattern::Uniform { drawn }, ..Layer::new(Paint::from(pigment), thickness, RELIEF * thickness) })
}
