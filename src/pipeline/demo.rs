//! The main job on the sample inside the program: fit, compare with the measurement, paint, and write a report.

use std::path::Path;

use super::{
    Painter, PipelineError, Progress, Studio, fit,
    report::{Cell, Figure, Report, Row},
};
use crate::{
    data::{Btf, Direction, Map, Material, PlaneView, Recipe},
    gpu::Gpu,
    io::{self, Source},
    model::{
        Appearance, FitSettings, Layer, LpcaSettings, Paint, PaintMethod, Pattern, Relief, TexelSamples, color::linear_from_srgb, pigments,
    },
};

/// Name of the report in the demo's folder.
pub const REPORT: &str = "report.html";
/// Name of the material in the demo's folder.
const MATERIAL: &str = "weave64.zarr";

/// Name of the sample inside the program.
pub const SAMPLE_NAME: &str = "weave64";

/// A path-traced woven cloth: 64 x 64 texels under 51 views and 51 lights.
const SAMPLE: &[u8] = include_bytes!("../sample/weave64_51x51.zip");

/// θ of the lights from the right, in degrees.
const LIGHTS: [f64; 5] = [0.0, 17.0, 32.0, 50.0, 65.0];
/// (θ, φ) in degrees: straight from above, and obliquely from the front.
const VIEWS: [(f64, f64); 2] = [(0.0, 0.0), (50.0, 257.0)];

/// Paints and the thicknesses that each is shown at: a glaze that the weave shows through, and a coat that hides it.
const PAINTS: [(&str, [f64; 2]); 2] = [("watercolour/hansa yellow", [0.5, 4.0]), ("watercolour/cerulean blue", [0.5, 4.0])];
/// Where the paint lies.
const PATTERN: Pattern = Pattern::Splash { seed: 3 };
/// Height in texel widths of a coat of thickness 1: the thick coats rise by half of what the yarns do.
const RELIEF: f64 = 0.15;
/// GGX α of the paint, fairly glossy.
const ROUGHNESS: f64 = 0.2;
/// How many times the sample lies side by side below the paint, along each edge.
const PIECES: usize = 2;
/// (θ, φ) in degrees of the painted pictures' view and light, almost opposite each other, and their size in pixels.
const PAINTED_VIEW: (f64, f64) = (35.0, 270.0);
const PAINTED_LIGHT: (f64, f64) = (50.0, 105.0);
const PAINTED_SIZE: [u32; 2] = [512, 424];

/// Runs the demo; writes the report, its pictures and the material into `folder`, which must exist.
///
/// # Errors
/// [`PipelineError`] if a stage fails or a file cannot be written.
pub fn demo(gpu: &Gpu, folder: &Path, progress: &Progress) -> Result<(), PipelineError> {
    let target = folder.join(MATERIAL);
    io::material::check_target(&target)?;
    let source = sample()?;
    let material = fit(gpu, source.as_ref(), &sample_settings(), progress)?;
    io::material::save(&target, &material)?;

    let job = Job { source: source.as_ref(), material: &material, studio: Studio::new(gpu)?, progress };
    progress.expect(4);
    let mut report = Report::new(folder, "A woven cloth, measured and painted", &introduction(source.btf(), gpu));
    for figure in [Job::recovered, Job::above, Job::oblique, Job::painted] {
        let figure = figure(&job)?;
        let _stage = progress.stage("report", 0, 0);
        report.figure(&figure)?;
        progress.advance(1);
    }
    report.finish(REPORT, &progress.report())?;
    Ok(())
}

fn sample() -> Result<Box<dyn Source>, PipelineError> {
    Ok(io::open_zip_bytes(SAMPLE_NAME, SAMPLE)?)
}

fn sample_settings() -> FitSettings {
    FitSettings { lpca: Some(LpcaSettings::default()), ..FitSettings::default() }
}

/// The material of the sample inside the program.
///
/// # Errors
/// [`PipelineError`] if a stage fails.
pub fn fit_sample(gpu: &Gpu, progress: &Progress) -> Result<Material, PipelineError> {
    fit(gpu, sample()?.as_ref(), &sample_settings(), progress)
}

fn introduction(btf: &Btf, gpu: &Gpu) -> String {
    let [width, height] = btf.size();
    format!(
        "{} by {} texels under {} views and {} lights, path-traced. overpaint {} recovered its height, normals and per-texel \
         reflectance on {}, and painted it. Directions are θ from the normal and φ counter-clockwise from the right, in degrees.",
        width,
        height,
        btf.views().len(),
        btf.lights().len(),
        env!("CARGO_PKG_VERSION"),
        gpu.adapter().name
    )
}

/// What the figures are made from.
struct Job<'a> {
    source: &'a dyn Source,
    material: &'a Material,
    studio: Studio<'a>,
    progress: &'a Progress,
}

impl Job<'_> {
    /// Top view, normals and height (thesis fig. 3.2).
    fn recovered(&self) -> Result<Figure, PipelineError> {
        let (view, light) = (nearest(self.source.btf().views(), VIEWS[0]), nearest(self.source.btf().lights(), (0.0, 0.0)));
        let (lowest, highest) = range(&self.material.height);
        let cells = vec![
            Cell { picture: self.original(view, light)?, note: String::new() },
            Cell { picture: self.material.normal.map(|normal| coded(normal.map(|value| 0.5 + 0.5 * value))), note: String::new() },
            Cell {
                picture: self.material.height.map(|height| coded([(height - lowest) / (highest - lowest).max(f32::MIN_POSITIVE); 3])),
                note: String::new(),
            },
        ];
        Ok(Figure {
            stem: "recovered".to_owned(),
            title: "What was measured and what was recovered".to_owned(),
            caption: format!(
                "Left, the photograph from the view {} under the light {}. Middle, normals, (x, y, z) from −1 … 1 as red, green and blue. \
                 Right, height, from {lowest:.2} (black) to {highest:.2} texel widths (white).",
                self.source.btf().views()[view],
                self.source.btf().lights()[light]
            ),
            columns: ["top view", "normals", "height"].map(String::from).to_vec(),
            rows: vec![Row { label: String::new(), cells }],
        })
    }

    /// Thesis fig. 4.1.
    fn above(&self) -> Result<Figure, PipelineError> {
        self.comparison("above", "Original and reconstruction, seen from above", VIEWS[0])
    }

    /// Thesis fig. 4.2.
    fn oblique(&self) -> Result<Figure, PipelineError> {
        self.comparison("oblique", "Original and reconstruction, seen obliquely", VIEWS[1])
    }

    /// Original, positive and negative difference and reconstruction, lit from the right at several elevations.
    fn comparison(&self, stem: &str, title: &str, view: (f64, f64)) -> Result<Figure, PipelineError> {
        let btf = self.source.btf();
        let view = nearest(btf.views(), view);
        let mut rows = ["original", "positive difference", "negative difference", "reconstruction", "local PCA"]
            .map(|label| Row { label: label.to_owned(), cells: Vec::new() });
        let mut columns = Vec::new();
        let subject = |appearance| self.studio.subject(self.material, appearance, self.progress);
        let (reflectance, lpca) = (subject(Appearance::svbrdf())?, subject(Appearance::Lpca { texel_samples: TexelSamples::One })?);
        for theta in LIGHTS {
            let light = nearest(btf.lights(), (theta, 0.0));
            let original = self.original(view, light)?;
            let picture = |subject| self.studio.picture(subject, btf.views()[view], btf.lights()[light], self.progress);
            let (found, compressed) = (picture(&reflectance)?, picture(&lpca)?);
            let note = |picture: &_| format!("relative RMS {:.3}", relative_rms(&original, picture));
            let cells = [
                Cell { note: String::new(), picture: original.clone() },
                Cell { note: String::new(), picture: difference(&original, &found) },
                Cell { note: String::new(), picture: difference(&found, &original) },
                Cell { note: note(&found), picture: found },
                Cell { note: note(&compressed), picture: compressed },
            ];
            rows.iter_mut().zip(cells).for_each(|(row, cell)| row.cells.push(cell));
            columns.push(format!("light {}", btf.lights()[light]));
        }
        Ok(Figure {
            stem: stem.to_owned(),
            title: title.to_owned(),
            caption: format!(
                "View {}; the light stands at the right. Positive difference is what the original has more than the reconstruction, negative \
                 difference what it has less, in linear light and not amplified. The relative RMS is that of the difference over that of the \
                 original, in linear light too. The local PCA has the original's own parallax and shadows, in {:.1} MB.",
                btf.views()[view],
                self.material.lpca.as_ref().map_or(0.0, |lpca| lpca.bytes() as f64 / 1e6)
            ),
            columns,
            rows: rows.into(),
        })
    }

    /// The bare material and two paints, each at two thicknesses.
    fn painted(&self) -> Result<Figure, PipelineError> {
        let [view, light] = [PAINTED_VIEW, PAINTED_LIGHT].map(|(theta, phi)| Direction::from_degrees(theta, phi));
        let shot = PlaneView::new(view, light, PAINTED_SIZE);
        let painter = Painter::new(self.studio.gpu())?;
        let cloth = self.material.repeated(PIECES, PIECES);
        let render = |recipe: Option<&Recipe>| {
            let surface = match recipe {
                None => self.studio.surface(&cloth, self.progress)?,
                Some(recipe) => {
                    self.studio.surface(&painter.paint(&cloth, recipe, PaintMethod::KubelkaMunk, self.progress)?, self.progress)?
                }
            };
            self.studio.render(&surface, &shot, Relief::default(), self.progress)
        };
        let bare = render(None)?;
        let mut rows = Vec::new();
        for (name, thicknesses) in PAINTS {
            let mut cells = vec![Cell { picture: bare.clone(), note: String::new() }];
            for thickness in thicknesses {
                // The library holds the paints named above.
                let Ok(pigment) = pigments::find(name) else { continue };
                let layer =
                    Layer { pattern: PATTERN, roughness: ROUGHNESS, ..Layer::new(Paint::from(pigment), thickness, RELIEF * thickness) };
                cells.push(Cell { picture: render(Some(&Recipe::of(layer)))?, note: format!("thickness {thickness}") });
            }
            rows.push(Row { label: name.to_owned(), cells });
        }
        Ok(Figure {
            stem: "painted".to_owned(),
            title: "Bare and painted".to_owned(),
            caption: format!(
                "View {view}, light {light}; {PIECES} by {PIECES} pieces of the sample. The paint is laid on by Kubelka and Munk's theory: a glaze takes \
                 light from the weave, which still shows, and a thick coat hides it. It raises the surface and has a highlight of its own."
            ),
            columns: ["bare", "thin coat", "thick coat"].map(String::from).to_vec(),
            rows,
        })
    }

    /// The sample of a view and a light, by their indices, in linear light.
    fn original(&self, view: usize, light: usize) -> Result<Map<[f32; 4]>, PipelineError> {
        let btf = self.source.btf();
        let [width, height] = btf.size();
        let Some(sample) = btf.pairs().iter().position(|pair| (pair.view, pair.light) == (view, light)) else {
            // The sample inside the program has every pair.
            return Ok(Map::from_fn(width, height, |_, _| [0.0; 4]));
        };
        let _stage = self.progress.stage("image_decode", btf.texels(), 1);
        Ok(self.source.picture(sample)?.map(|&[red, green, blue]| [red, green, blue, 1.0]))
    }
}

/// Index of the direction nearest (θ, φ) in degrees.
fn nearest(directions: &[Direction], (theta, phi): (f64, f64)) -> usize {
    let wanted = Direction::from_degrees(theta, phi).vector();
    let cosine = |index: &usize| directions[*index].vector().dot(wanted);
    (0..directions.len()).max_by(|a, b| cosine(a).total_cmp(&cosine(b))).unwrap_or(0)
}

/// Smallest and largest height.
fn range(map: &Map<f32>) -> (f32, f32) {
    map.values().iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), &value| (low.min(value), high.max(value)))
}

/// The linear light that a PNG stores as the code `value`, from 0 to 1: for pictures that show numbers, not light.
fn coded(value: [f32; 3]) -> [f32; 4] {
    let [red, green, blue] = value.map(decoded);
    [red, green, blue, 1.0]
}

/// The linear light of an sRGB value, both from 0 to 1.
#[expect(clippy::cast_possible_truncation, reason = "a picture holds f32")]
fn decoded(srgb: f32) -> f32 {
    linear_from_srgb(f64::from(srgb)) as f32
}

/// max(a − b, 0).
fn difference(a: &Map<[f32; 4]>, b: &Map<[f32; 4]>) -> Map<[f32; 4]> {
    Map::from_fn(a.width(), a.height(), |column, row| {
        let (a, b) = (a[(column, row)], b[(column, row)]);
        [(a[0] - b[0]).max(0.0), (a[1] - b[1]).max(0.0), (a[2] - b[2]).max(0.0), 1.0]
    })
}

/// √(Σ(original − found)² / Σ original²) over red, green and blue.
fn relative_rms(original: &Map<[f32; 4]>, found: &Map<[f32; 4]>) -> f64 {
    let channels =
        |map: &Map<[f32; 4]>| -> Vec<f64> { map.values().iter().flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).map(f64::from).collect() };
    let (original, found) = (channels(original), channels(found));
    let error: f64 = original.iter().zip(&found).map(|(original, found)| (original - found).powi(2)).sum();
    (error / original.iter().map(|value| value * value).sum::<f64>()).sqrt()
}
