//! The report of a comparison: plot, tables, and pictures in the layout of the thesis' figures 4.1, 4.2 and 3.4.

use super::{
    AtElevation, CompareSettings, Comparison, Quality,
    elevations::Elevations,
    lpca, plot, radiance,
    texel::{self, Measurement},
};
use crate::{
    data::{Direction, Lpca, Map, Material},
    io::Source,
    model::{Appearance, Relief},
    pipeline::{
        PipelineError, Progress, Studio, Subject,
        report::{Cell, Figure, Report, Row},
    },
};

/// Factor of the differences that are shown.
const AMPLIFIED: f32 = 2.0;

/// Lights from the right in a sheet.
const LIGHTS: usize = 5;

/// (θ, φ) in degrees of the oblique view.
const OBLIQUE: (f64, f64) = (50.0, 270.0);

/// Pairs of the worst that are shown.
const WORST: usize = 5;

/// What the report is made from.
pub struct Job<'a> {
    pub source: &'a dyn Source,
    pub material: &'a Material,
    pub settings: &'a CompareSettings,
    pub comparison: &'a Comparison,
    pub studio: &'a Studio<'a>,
    pub progress: &'a Progress,
}

impl Job<'_> {
    /// Adds everything to `report`.
    pub fn write(&self, report: &mut Report<'_>) -> Result<(), PipelineError> {
        let stage = self.progress.stage("report", 0, 0);
        report.drawing("errors", "Errors by angle", &self.errors_caption(), &plot::svg(self.comparison)?)?;
        self.tables(report);
        if let Some(lpca) = self.lpca() {
            lpca::learned(lpca, report)?;
        }
        drop(stage);

        let btf = self.source.btf();
        let subject = self.studio.subject(self.material, self.settings.appearance, self.progress)?;
        let views = || btf.pairs().iter().map(|pair| (pair.view, btf.views()[pair.view]));
        let (zenith, oblique) = (nearest(views(), (0.0, 0.0)), nearest(views(), OBLIQUE));
        let mut figures = Vec::new();
        if let Some(view) = zenith {
            figures.push(self.sheet("above", "Seen from above", &subject, view)?);
        }
        if let Some(view) = oblique.filter(|_| oblique != zenith) {
            figures.push(self.sheet("oblique", "Seen obliquely", &subject, view)?);
        }
        if !self.comparison.worst_pairs.is_empty() {
            figures.push(self.worst(&subject)?);
        }
        figures.extend(self.texels(zenith)?);
        match (self.lpca(), self.settings.texel) {
            (Some(_), _) => figures.push(lpca::between(self, &subject)?),
            (None, Some(at)) => figures.push(self.texel(at)),
            (None, None) => {}
        }
        let _stage = self.progress.stage("report", 0, 0);
        figures.iter().try_for_each(|figure| report.figure(figure))
    }

    /// The local PCA, if that is compared.
    fn lpca(&self) -> Option<&Lpca> {
        self.material.lpca.as_ref().filter(|_| matches!(self.settings.appearance, Appearance::Lpca { .. }))
    }

    fn errors_caption(&self) -> String {
        let Quality { relative_rms, psnr_db, bias, pairs } = self.comparison.overall;
        format!(
            "Over all {pairs} pairs the relative RMS error is {}, the PSNR {} dB and the mean signed error {} of the mean. The relative RMS \
             error is √(Σ(R − L)² / Σ L²) with R the reconstruction and L the original in linear light, red, green and blue together; the mean \
             signed error is Σ(R − L) / Σ L, below 0 where the reconstruction is too dark; the PSNR is that of sRGB values held to 0 … 1, its \
             peak 1. θ is the angle to the normal.",
            number(relative_rms, 4),
            number(psnr_db, 2),
            percent(bias)
        )
    }

    /// The figures by θ of view and light.
    fn tables(&self, report: &mut Report<'_>) {
        let header = ["θ", "pairs", "relative RMS", "PSNR / dB", "mean signed error"].map(String::from);
        let rows = |groups: &[AtElevation]| -> Vec<Vec<String>> {
            let row = |AtElevation { theta_degrees, quality }: &AtElevation| {
                let Quality { relative_rms, psnr_db, bias, pairs } = *quality;
                vec![theta_degrees.to_string(), pairs.to_string(), number(relative_rms, 4), number(psnr_db, 2), percent(bias)]
            };
            groups.iter().map(row).collect()
        };
        let Comparison { by_view_elevation, by_light_elevation, by_view_and_light_elevation, .. } = self.comparison;
        report.table("By θ of the view", "", &header, &rows(by_view_elevation));
        report.table("By θ of the light", "", &header, &rows(by_light_elevation));
        let thetas = |groups: &[AtElevation]| groups.iter().map(|group| group.theta_degrees).collect::<Vec<_>>();
        let (views, lights) = (thetas(by_view_elevation), thetas(by_light_elevation));
        if views.len() == 1 || lights.len() == 1 {
            return;
        }
        let header: Vec<String> = ["light \\ view".to_owned()].into_iter().chain(views.iter().map(f64::to_string)).collect();
        let cell = |view: f64, light: f64| {
            let found = by_view_and_light_elevation.iter().find(|at| at.view_theta_degrees == view && at.light_theta_degrees == light);
            found.map_or_else(String::new, |at| format!("{} ({})", number(at.quality.relative_rms, 3), percent(at.quality.bias)))
        };
        let row = |light: &f64| [light.to_string()].into_iter().chain(views.iter().map(|view| cell(*view, *light))).collect();
        let rows: Vec<Vec<String>> = lights.iter().map(row).collect();
        report.table("By θ of both", "Relative RMS error, and the mean signed error in brackets.", &header, &rows);
    }

    /// Light from the right at several elevations, a row each (thesis fig. 4.1 and 4.2).
    fn sheet(&self, stem: &'static str, title: &'static str, subject: &Subject, view: usize) -> Result<Figure, PipelineError> {
        let btf = self.source.btf();
        let samples: Vec<usize> = (0..btf.pairs().len()).filter(|&sample| btf.pairs()[sample].view == view).collect();
        let lights: Vec<Direction> = samples.iter().map(|&sample| btf.directions(sample).1).collect();
        let elevations = Elevations::new(&lights);
        // Rings that stand evenly between the lowest and the highest.
        let rings = elevations.thetas.len();
        let mut chosen: Vec<usize> = (0..LIGHTS).map(|index| index * (rings - 1) / (LIGHTS - 1)).collect();
        chosen.dedup();
        let from_right = |ring: usize| {
            let of_ring = samples.iter().enumerate().filter(|(index, _)| elevations.of[*index] == ring);
            nearest(of_ring.map(|(index, sample)| (*sample, lights[index])), (elevations.thetas[ring], 0.0))
        };
        let rows = chosen.into_iter().filter_map(from_right).map(|sample| {
            let light = btf.directions(sample).1;
            self.row(subject, sample, together(&format!("light {light}")))
        });
        Ok(Figure {
            stem: stem.to_owned(),
            title: title.to_owned(),
            caption: format!("View {}, light from the right. {}", btf.views()[view], differences()),
            columns: columns(),
            rows: rows.collect::<Result<_, _>>()?,
        })
    }

    /// The pairs of the largest relative RMS.
    fn worst(&self, subject: &Subject) -> Result<Figure, PipelineError> {
        let btf = self.source.btf();
        let rows = self.comparison.worst_pairs.iter().take(WORST).map(|pair| {
            let (view, light) = btf.directions(pair.sample);
            self.row(subject, pair.sample, together(&format!("view {view}")) + " " + &together(&format!("light {light}")))
        });
        Ok(Figure {
            stem: "worst".to_owned(),
            title: "Worst pairs".to_owned(),
            caption: format!("The pairs of the largest relative RMS error. {}", differences()),
            columns: columns(),
            rows: rows.collect::<Result<_, _>>()?,
        })
    }

    /// Original, differences and reconstruction of a pair.
    fn row(&self, subject: &Subject, sample: usize, label: String) -> Result<Row, PipelineError> {
        let (view, light) = self.source.btf().directions(sample);
        let original = self.original(sample)?;
        let found = self.studio.picture(subject, view, light, self.progress)?;
        // Signed, positive where the original has more.
        let difference = |sign: f32| {
            Map::from_fn(found.width(), found.height(), |column, row| {
                let (original, [r, g, b, _]) = (original[(column, row)], found[(column, row)]);
                let [red, green, blue] = [original[0] - r, original[1] - g, original[2] - b].map(|more| (sign * AMPLIFIED * more).max(0.0));
                // Where the original is masked there is nothing to compare.
                if original[3] > 0.0 { [red, green, blue, 1.0] } else { [0.0; 4] }
            })
        };
        let error = relative_rms(&original, &found);
        let cells = [difference(1.0), difference(-1.0)];
        let note = format!("relative RMS {}", number(error, 3));
        let plain = |picture| Cell { picture, note: String::new() };
        let [positive, negative] = cells.map(plain);
        Ok(Row { label, cells: vec![plain(original), positive, negative, Cell { picture: found, note }] })
    }

    /// The sample in linear light, transparent where it is masked.
    fn original(&self, sample: usize) -> Result<Map<[f32; 4]>, PipelineError> {
        let _stage = self.progress.stage("read", self.source.btf().texels(), 1);
        let picture = self.source.picture(sample)?;
        Ok(picture.map(|&channels| radiance(channels).map_or([0.0; 4], |[red, green, blue]| [red, green, blue, 1.0])))
    }

    /// Where the error is: the relative RMS of each texel beside the view from above.
    fn texels(&self, zenith: Option<usize>) -> Result<Option<Figure>, PipelineError> {
        let mut found: Vec<f64> = self.comparison.texels.values().iter().copied().flatten().collect();
        found.sort_unstable_by(f64::total_cmp);
        let Some(&worst) = found.last() else { return Ok(None) };
        // White is what a hundredth of the texels reaches, so that one of them does not darken all others.
        let white = found[(found.len() - 1) * 99 / 100].max(f64::MIN_POSITIVE);
        let map = self.comparison.texels.map(|error| error.map_or([0.0; 4], |error| coded(error / white)));
        let btf = self.source.btf();
        let samples = (0..btf.pairs().len()).filter(|&sample| Some(btf.pairs()[sample].view) == zenith);
        let from_above = nearest(samples.map(|sample| (sample, btf.directions(sample).1)), (30.0, 0.0));
        let mut cells = Vec::new();
        let mut columns = Vec::new();
        if let Some(sample) = from_above {
            cells.push(Cell { picture: self.original(sample)?, note: String::new() });
            columns.push(format!("original, light {}", btf.directions(sample).1));
        }
        cells.push(Cell { picture: map, note: String::new() });
        columns.push("relative RMS error".to_owned());
        let named = self.comparison.worst_texels.iter().map(|texel| format!("{},{} ({:.3})", texel.column, texel.row, texel.relative_rms));
        let named = named.collect::<Vec<_>>().join(", ");
        Ok(Some(Figure {
            stem: "texels".to_owned(),
            title: "Where the error is".to_owned(),
            caption: format!(
                "Relative RMS error of each texel over all pairs, from 0 (black) to {white:.3} and above (white; a hundredth of the texels); the \
                 largest is {worst:.3}. Worst texels as column,row: {named}."
            ),
            columns,
            rows: vec![Row { label: String::new(), cells }],
        }))
    }

    /// One texel's measurement through the steps of the fit.
    fn texel(&self, at: [usize; 2]) -> Figure {
        let steps = texel::steps(self.source.btf(), &self.material.svbrdf, at, &self.comparison.texel, &self.comparison.framed);
        let columns = [
            ("radiance", ["1 measured", "reconstruction × shading"], steps.radiance),
            ("reflectance", ["2 radiance / shading", "6 reconstruction ρ_d + ρ_s lobe"], steps.reflectance),
            ("specular part", ["3 less ρ_d, no less than 0", "ρ_s lobe"], steps.specular),
            ("mean of the channels", ["4 mean of 3", "5 fitted lobe"], steps.mean),
        ];
        // Few views are drawn higher.
        let btf = self.source.btf();
        let higher = (btf.lights().len() / (4 * btf.views().len())).max(1);
        let mut rows = ["measurement", "material"].map(|label| Row { label: label.to_owned(), cells: Vec::new() });
        let mut headings = Vec::new();
        for (heading, notes, step) in columns {
            // A column has one scale.
            let white = percentile(&step);
            headings.push(format!("{heading}, white is {white:.3}"));
            for ((row, note), measurement) in rows.iter_mut().zip(notes).zip(&step) {
                let picture = Map::from_fn(measurement.width(), higher * measurement.height(), |light, row| {
                    measurement[(light, row / higher)].map_or([0.0; 4], |rgb| scaled(rgb, white))
                });
                row.cells.push(Cell { picture, note: note.to_owned() });
            }
        }
        Figure {
            stem: "texel".to_owned(),
            title: "One texel's measurement and its fit".to_owned(),
            caption: format!(
                "Texel {},{}: a row a view, a column a light, in the order of the source. Above, the measurement through the steps of the fit; \
                 below each step what the material has in its place.",
                at[0], at[1]
            ),
            columns: headings,
            rows: rows.into(),
        }
    }
}

impl Comparison {
    /// What was compared, in a paragraph.
    pub(super) fn introduction(&self) -> String {
        let [width, height] = self.size;
        let with = |on: bool| if on { "with" } else { "without" };
        let made = match self.appearance {
            Appearance::Svbrdf { relief: Relief { displace, shadow, .. } } => {
                format!("the material {} displacement and {} shadows of its height field", with(displace), with(shadow))
            }
            Appearance::Lpca { .. } => "the material's local PCA".to_owned(),
        };
        format!(
            "{width} by {height} texels, {} pairs of a view and a light, each reconstructed from {made}, on {}, by overpaint {}. The figures are \
             in compare.json too. Directions are θ from the normal and φ counter-clockwise from the right, in degrees.",
            self.overall.pairs, self.adapter.name, self.version
        )
    }
}

fn columns() -> Vec<String> {
    ["original", "positive difference", "negative difference", "reconstruction"].map(String::from).to_vec()
}

fn differences() -> String {
    format!(
        "Positive difference is what the original has more than the reconstruction, negative difference what it has less, in linear light, \
         times {AMPLIFIED}."
    )
}

/// The key of the direction nearest (θ, φ) in degrees.
fn nearest(directions: impl Iterator<Item = (usize, Direction)>, (theta, phi): (f64, f64)) -> Option<usize> {
    let wanted = Direction::from_degrees(theta, phi).vector();
    let far = |direction: Direction| direction.vector().distance_squared(wanted);
    directions.map(|(key, direction)| (key, far(direction))).min_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(key, _)| key)
}

/// √(Σ(R − L)² / Σ L²) of a picture.
fn relative_rms(original: &Map<[f32; 4]>, found: &Map<[f32; 4]>) -> Option<f64> {
    let pairs = || original.values().iter().zip(found.values()).filter(|(original, _)| original[3] > 0.0);
    let sum = |term: fn(f64, f64) -> f64| -> f64 {
        pairs().flat_map(|(l, r)| (0..3).map(move |c| (f64::from(r[c]), f64::from(l[c])))).map(|(r, l)| term(r, l)).sum()
    };
    let energy = sum(|_, l| l * l);
    (energy > 0.0).then(|| (sum(|r, l| (r - l).powi(2)) / energy).sqrt())
}

/// The value that a hundredth of all of both measurements exceeds, above 0.
fn percentile(measurements: &[Measurement; 2]) -> f64 {
    let mut values: Vec<f64> = measurements.iter().flat_map(|map| map.values().iter().flatten().flatten().copied()).collect();
    values.sort_unstable_by(f64::total_cmp);
    values.get(values.len().saturating_sub(1) * 99 / 100).copied().unwrap_or_default().max(1e-6)
}

/// A value over `white` in linear light.
#[expect(clippy::cast_possible_truncation, reason = "a picture holds f32")]
fn scaled(rgb: [f64; 3], white: f64) -> [f32; 4] {
    let [red, green, blue] = rgb.map(|value| (value / white) as f32);
    [red, green, blue, 1.0]
}

/// A shade from black, 0, to white, 1, evenly spaced to the eye.
fn coded(value: f64) -> [f32; 4] {
    scaled([crate::model::color::linear_from_srgb(value.clamp(0.0, 1.0)); 3], 1.0)
}

/// A text that is not broken into lines.
fn together(text: &str) -> String {
    text.replace(' ', "\u{a0}")
}

fn number(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(|| "–".to_owned(), |value| format!("{value:.digits$}"))
}

fn percent(value: Option<f64>) -> String {
    value.map_or_else(|| "–".to_owned(), |value| format!("{:+.1} %", 100.0 * value).replace('-', "−"))
}
