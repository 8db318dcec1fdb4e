//! What a comparison says in numbers.

use serde::Serialize;
use serde_json::{Value, json};

use super::{elevations::Elevations, measure::Sums, texel::Framed};
use crate::{
    data::{Btf, Direction, Map},
    gpu::AdapterSummary,
    model::Appearance,
};

/// Pairs and texels that are named as the worst.
const WORST: usize = 10;

/// What the figures are, for those who read the numbers alone.
const DEFINITIONS: [(&str, &str); 5] = [
    (
        "values",
        "R the reconstruction, L the original, linear in reflectance units (a white Lambertian plane lit at theta reads cos theta), red, green and blue together; texels whose original is NaN, infinite or negative are left out",
    ),
    ("relative_rms", "sqrt(sum (R - L)^2 / sum L^2)"),
    ("psnr_db", "10 log10(1 / mean (r - l)^2) with r and l the sRGB values of R and L held to 0..1, the peak 1; null where they are equal"),
    ("bias", "sum (R - L) / sum L: below 0 the reconstruction is too dark"),
    ("theta_degrees", "angle to the normal; the middle of 5 degrees where directions have more than 24 different ones"),
];

/// How well reconstructions agree with their originals.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Quality {
    /// √(Σ(R − L)² / Σ L²); none where every original is black.
    pub relative_rms: Option<f64>,
    /// Peak signal-to-noise ratio in dB of sRGB values held to 0 … 1, the peak 1; none where they are equal.
    pub psnr_db: Option<f64>,
    /// Σ(R − L) / Σ L, below 0 where the reconstruction is too dark; none where every original is black.
    pub bias: Option<f64>,
    /// Pairs of a view and a light.
    pub pairs: usize,
}

impl From<Sums> for Quality {
    fn from(sums: Sums) -> Self {
        let Sums { squared_error, error, squared_original, original, squared_shown_error, texels, pairs } = sums;
        Self {
            relative_rms: (squared_original > 0.0).then(|| (squared_error / squared_original).sqrt()),
            psnr_db: (squared_shown_error > 0.0).then(|| -10.0 * (squared_shown_error / (3.0 * texels)).log10()),
            bias: (original > 0.0).then(|| error / original),
            pairs,
        }
    }
}

/// Quality at an angle to the normal.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AtElevation {
    /// θ in degrees.
    pub theta_degrees: f64,
    /// Over all pairs of it.
    #[serde(flatten)]
    pub quality: Quality,
}

/// Quality at the angles to the normal of view and light.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AtElevations {
    /// θ of the views in degrees.
    pub view_theta_degrees: f64,
    /// θ of the lights in degrees.
    pub light_theta_degrees: f64,
    /// Over all pairs of both.
    #[serde(flatten)]
    pub quality: Quality,
}

/// Quality of one pair.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PairQuality {
    /// Its index in the source.
    pub sample: usize,
    /// (θ, φ) of its view in degrees.
    pub view_degrees: [f64; 2],
    /// (θ, φ) of its light in degrees.
    pub light_degrees: [f64; 2],
    /// Over its texels.
    #[serde(flatten)]
    pub quality: Quality,
}

/// Error of one texel.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TexelError {
    /// From the left.
    pub column: usize,
    /// From the top.
    pub row: usize,
    /// √(Σ(R − L)² / Σ L²) over all pairs.
    pub relative_rms: f64,
}

/// How a material's reconstructions agree with its source.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Comparison {
    /// Name of the source.
    pub source: String,
    /// Columns and rows.
    pub size: [usize; 2],
    /// What the reconstructions are made from.
    #[serde(flatten)]
    pub appearance: Appearance,
    /// The adapter that computed it.
    pub adapter: AdapterSummary,
    /// Version of overpaint.
    pub version: String,
    /// Seconds that it took.
    pub seconds: f64,
    /// Samples of a texel that take no part since they are no radiance, summed over texels.
    pub masked: u64,
    /// Over all pairs.
    pub overall: Quality,
    /// By θ of the view.
    pub by_view_elevation: Vec<AtElevation>,
    /// By θ of the light.
    pub by_light_elevation: Vec<AtElevation>,
    /// By θ of both, those of which there are pairs.
    pub by_view_and_light_elevation: Vec<AtElevations>,
    /// The pairs of the largest relative RMS.
    pub worst_pairs: Vec<PairQuality>,
    /// The texels of the largest relative RMS.
    pub worst_texels: Vec<TexelError>,
    /// Relative RMS of each texel over all pairs, none where every original is black or masked.
    #[serde(skip)]
    pub texels: Map<Option<f64>>,
    /// L of the texel that was asked for in each pair, none where it is masked.
    #[serde(skip)]
    pub texel: Vec<Option<[f32; 3]>>,
    /// The frames of that texel's reflectance in each pair; none of a local PCA.
    #[serde(skip)]
    pub framed: Vec<Framed>,
}

/// All figures that follow from the sums of pairs and texels.
pub struct Figures {
    pub overall: Quality,
    pub masked: u64,
    pub by_view_elevation: Vec<AtElevation>,
    pub by_light_elevation: Vec<AtElevation>,
    pub by_view_and_light_elevation: Vec<AtElevations>,
    pub worst_pairs: Vec<PairQuality>,
    pub worst_texels: Vec<TexelError>,
    pub texels: Map<Option<f64>>,
}

impl Figures {
    pub fn new(btf: &Btf, pairs: &[Sums], texels: &Map<[f64; 2]>) -> Self {
        let (views, lights) = (Elevations::new(btf.views()), Elevations::new(btf.lights()));
        let mut overall = Sums::default();
        let mut by_both = vec![vec![Sums::default(); lights.thetas.len()]; views.thetas.len()];
        for (pair, sums) in btf.pairs().iter().zip(pairs) {
            overall += *sums;
            by_both[views.of[pair.view]][lights.of[pair.light]] += *sums;
        }
        let sum = |sums: &mut dyn Iterator<Item = &Sums>| {
            sums.fold(Sums::default(), |mut all, sums| {
                all += *sums;
                all
            })
        };
        let at = |theta: &f64, sums: Sums| AtElevation { theta_degrees: *theta, quality: sums.into() };
        let view = |(theta, of_view): (&f64, &Vec<Sums>)| at(theta, sum(&mut of_view.iter()));
        let light = |(index, theta): (usize, &f64)| at(theta, sum(&mut by_both.iter().map(|of_view| &of_view[index])));
        let both = |(view, of_view): (&f64, &Vec<Sums>)| {
            let cell = |(light, sums): (&f64, &Sums)| AtElevations {
                view_theta_degrees: *view,
                light_theta_degrees: *light,
                quality: (*sums).into(),
            };
            lights.thetas.iter().zip(of_view).filter(|(_, sums)| sums.pairs > 0).map(cell).collect::<Vec<_>>()
        };
        let relative = texels.map(|[error, original]| (*original > 0.0).then(|| (error / original).sqrt()));
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "texels are counted in whole numbers")]
        let valid = overall.texels as u64;
        Self {
            overall: overall.into(),
            masked: (btf.texels() * pairs.len()) as u64 - valid,
            by_view_elevation: views.thetas.iter().zip(&by_both).map(view).collect(),
            by_light_elevation: lights.thetas.iter().enumerate().map(light).collect(),
            by_view_and_light_elevation: views.thetas.iter().zip(&by_both).flat_map(both).collect(),
            worst_pairs: worst_pairs(btf, pairs),
            worst_texels: worst_texels(&relative),
            texels: relative,
        }
    }
}

/// Indices of the largest values, the largest first; of equal ones the first.
fn largest(values: impl Iterator<Item = Option<f64>>) -> Vec<(usize, f64)> {
    let mut found: Vec<(usize, f64)> = values.enumerate().filter_map(|(index, value)| Some((index, value?))).collect();
    found.sort_by(|(_, a), (_, b)| b.total_cmp(a));
    found.truncate(WORST);
    found
}

fn worst_pairs(btf: &Btf, pairs: &[Sums]) -> Vec<PairQuality> {
    let quality = |sample: usize| Quality::from(pairs[sample]);
    let degrees = |direction: Direction| <[f64; 2]>::from(direction.degrees()).map(|degrees| (degrees * 1e6).round() / 1e6);
    let named = |(sample, _)| {
        let (view, light) = btf.directions(sample);
        PairQuality { sample, view_degrees: degrees(view), light_degrees: degrees(light), quality: quality(sample) }
    };
    largest((0..pairs.len()).map(|sample| quality(sample).relative_rms)).into_iter().map(named).collect()
}

fn worst_texels(texels: &Map<Option<f64>>) -> Vec<TexelError> {
    let named = |(texel, relative_rms)| TexelError { column: texel % texels.width(), row: texel / texels.width(), relative_rms };
    largest(texels.values().iter().copied()).into_iter().map(named).collect()
}

impl Comparison {
    /// All figures and what they mean, as `compare.json` holds them; `material` says where the material came from.
    #[must_use]
    pub fn json(&self, material: &Value) -> Value {
        let definitions: serde_json::Map<_, _> =
            DEFINITIONS.into_iter().map(|(name, meaning)| (name.to_owned(), Value::from(meaning))).collect();
        let mut all = json!({ "format": super::FORMAT, "format_version": 1, "definitions": definitions, "material": material });
        if let (Value::Object(all), Ok(Value::Object(figures))) = (&mut all, serde_json::to_value(self)) {
            all.extend(figures);
        }
        all
    }
}
