//! Figures of what was measured and what was recovered of it.

use super::{
    PipelineError, Progress, Studio,
    report::{Cell, Figure, Row},
};
use crate::{
    data::{Direction, Map, Material},
    io::Source,
    model::{Appearance, TexelSamples, color::linear_from_srgb},
};

/// θ of the lights from the right, in degrees.
const LIGHTS: [f64; 5] = [0.0, 17.0, 32.0, 50.0, 65.0];
/// (θ, φ) in degrees: straight from above, and obliquely from the front.
const VIEWS: [(f64, f64); 2] = [(0.0, 0.0), (50.0, 257.0)];

/// A material and the source it was recovered from.
pub(super) struct Measured<'a> {
    pub source: &'a dyn Source,
    pub material: &'a Material,
    pub studio: &'a Studio<'a>,
    pub progress: &'a Progress,
}

impl Measured<'_> {
    /// Top view, normals and height (thesis fig. 3.2).
    pub(super) fn recovered(&self) -> Result<Figure, PipelineError> {
        let (view, light) = {
            let view = nearest(self.source.btf().views(), VIEWS[0]);
            (view, self.nearest_light(view, (0.0, 0.0)))
        };
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
    pub(super) fn above(&self) -> Result<Figure, PipelineError> {
        self.comparison("above", "Original and reconstruction, seen from above", VIEWS[0])
    }

    /// Thesis fig. 4.2.
    pub(super) fn oblique(&self) -> Result<Figure, PipelineError> {
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
        let reflectance = subject(Appearance::svbrdf())?;
        let has_lpca = self.material.lpca.is_some();
        let lpca = has_lpca.then(|| subject(Appearance::Lpca { texel_samples: TexelSamples::One })).transpose()?;
        for theta in LIGHTS {
            let light = self.nearest_light(view, (theta, 0.0));
            let original = self.original(view, light)?;
            let picture = |subject| self.studio.picture(subject, btf.views()[view], btf.lights()[light], self.progress);
            let found = picture(&reflectance)?;
            let note = |picture: &_| format!("relative RMS {:.3}", relative_rms(&original, picture));
            let mut cells = vec![
                Cell { note: String::new(), picture: original.clone() },
                Cell { note: String::new(), picture: difference(&original, &found) },
                Cell { note: String::new(), picture: difference(&found, &original) },
                Cell { note: note(&found), picture: found },
            ];
            if let Some(lpca) = &lpca {
                let compressed = picture(lpca)?;
                cells.push(Cell { note: note(&compressed), picture: compressed });
            }
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
            rows: rows.into_iter().filter(|row| !row.cells.is_empty()).collect(),
        })
    }

    /// Of the lights that the view was photographed under, the one nearest (θ, φ) in degrees.
    fn nearest_light(&self, view: usize, light: (f64, f64)) -> usize {
        let btf = self.source.btf();
        let of_view: Vec<usize> = btf.pairs().iter().filter(|pair| pair.view == view).map(|pair| pair.light).collect();
        let lights: Vec<Direction> = of_view.iter().map(|&light| btf.lights()[light]).collect();
        of_view.get(nearest(&lights, light)).copied().unwrap_or(0)
    }

    /// The sample of a view and a light, by their indices, in linear light.
    fn original(&self, view: usize, light: usize) -> Result<Map<[f32; 4]>, PipelineError> {
        let btf = self.source.btf();
        let [width, height] = btf.size();
        let Some(sample) = btf.pairs().iter().position(|pair| (pair.view, pair.light) == (view, light)) else {
            // A view without a single light.
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
