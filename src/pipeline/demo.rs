//! The main job on the sample inside the program: fit, compare with the measurement, paint, and write a report.

use std::path::Path;

use super::{
    Painter, PipelineError, Progress, Studio, fit,
    measured::Measured,
    report::{Cell, Figure, Report, Row},
};
use crate::{
    data::{Btf, Direction, Material, PlaneView, Recipe},
    gpu::Gpu,
    io::{self, Source},
    model::{FitSettings, Layer, LpcaSettings, Paint, PaintMethod, Pattern, Relief, pigments},
};

/// Name of the report in the demo's folder.
pub const REPORT: &str = "report.html";
/// Name of the material in the demo's folder.
const MATERIAL: &str = "weave64.zarr";

/// Name of the sample inside the program.
pub(super) const SAMPLE_NAME: &str = "weave64";

/// A path-traced woven cloth: 64 x 64 texels under 51 views and 51 lights.
const SAMPLE: &[u8] = include_bytes!("../sample/weave64_51x51.zip");

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

    let studio = Studio::new(gpu)?;
    let measured = Measured { source: source.as_ref(), material: &material, studio: &studio, progress };
    progress.expect(4);
    let mut report = Report::new(folder, "A woven cloth, measured and painted", &introduction(source.btf(), gpu));
    let figures: [&dyn Fn() -> Result<Figure, PipelineError>; 4] =
        [&|| measured.recovered(), &|| measured.above(), &|| measured.oblique(), &|| painted(&studio, &material, progress)];
    for figure in figures {
        let figure = figure()?;
        let _stage = progress.stage("report", 0, 0);
        report.figure(&figure)?;
        progress.advance(1);
    }
    report.finish(REPORT, &progress.report())?;
    Ok(())
}

pub(super) fn sample() -> Result<Box<dyn Source>, PipelineError> {
    Ok(io::open_zip_bytes(SAMPLE_NAME, SAMPLE)?)
}

fn sample_settings() -> FitSettings {
    FitSettings { lpca: Some(LpcaSettings::default()), ..FitSettings::default() }
}

/// The material of the sample inside the program.
///
/// # Errors
/// [`PipelineError`] if a stage fails.
pub(super) fn fit_sample(gpu: &Gpu, progress: &Progress) -> Result<Material, PipelineError> {
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

/// The bare material and two paints, each at two thicknesses.
fn painted(studio: &Studio<'_>, material: &Material, progress: &Progress) -> Result<Figure, PipelineError> {
    let [view, light] = [PAINTED_VIEW, PAINTED_LIGHT].map(|(theta, phi)| Direction::from_degrees(theta, phi));
    let shot = PlaneView::new(view, light, PAINTED_SIZE);
    let painter = Painter::new(studio.gpu())?;
    let cloth = material.repeated(PIECES, PIECES);
    let render = |recipe: Option<&Recipe>| {
        let surface = match recipe {
            None => studio.surface(&cloth, progress)?,
            Some(recipe) => studio.surface(&painter.paint(&cloth, recipe, PaintMethod::KubelkaMunk, progress)?, progress)?,
        };
        studio.render(&surface, &shot, Relief::default(), progress)
    };
    let bare = render(None)?;
    let mut rows = Vec::new();
    for (name, thicknesses) in PAINTS {
        let mut cells = vec![Cell { picture: bare.clone(), note: String::new() }];
        for thickness in thicknesses {
            // The library holds the paints named above.
            let Ok(pigment) = pigments::find(name) else { continue };
            let layer = Layer { pattern: PATTERN, roughness: ROUGHNESS, ..Layer::new(Paint::from(pigment), thickness, RELIEF * thickness) };
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
