//! `overpaint info`.

use std::{collections::BTreeMap, fmt::Display, path::PathBuf};

use clap::{Args, CommandFactory, error::ErrorKind};
use serde::{Serialize, Serializer};

use super::{Cli, CliError, reading::ReadingArguments, say};
use crate::{
    data::{Btf, Choice, Direction, Encoding, FitStatus, Lpca, Material, Provenance, RowOrder, Transfer},
    io::{
        self,
        conventions::{self, Convention},
    },
    model::Layer,
};

/// Tell what a source or a material holds.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  overpaint info cloth.zip\n  overpaint info cloth.zip --every 3\n  overpaint info cloth.zarr --json")]
pub struct Info {
    /// A source (a folder or .zip of images, an .lp file) or a material
    path: PathBuf,
    /// Print JSON, every direction included
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    reading: ReadingArguments,
}

impl Info {
    pub fn run(self) -> Result<(), CliError> {
        let content = match io::kind(&self.path) {
            io::Kind::Material if self.reading.is_given() => {
                let message = format!("{} is a material: options for reading are for sources; leave them out here", self.path.display());
                return Err(Cli::command().error(ErrorKind::ArgumentConflict, message).into());
            }
            io::Kind::Material => Content::of_material(&io::material::load(&self.path)?, io::material::lpca_bytes(&self.path)?),
            // What is neither is refused by `open`, which says why.
            io::Kind::Source | io::Kind::Neither => Content::of_source(io::open_with(&self.path, &self.reading.options())?.btf()),
        };
        let text = if self.json {
            serde_json::to_string_pretty(&content).map_err(|error| CliError::Stdout { source: error.into() })?
        } else {
            content.describe()
        };
        say(&text)
    }
}

/// Rings of directions that are listed one by one; all of the known grids have fewer.
const LISTED_RINGS: usize = 12;

/// Missing pairs that are listed.
const LISTED_PAIRS: usize = 4;

/// What a path holds, as printed.
#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
enum Content {
    Source {
        name: String,
        width: usize,
        height: usize,
        #[serde(flatten)]
        measured: Measured,
        #[serde(serialize_with = "as_map")]
        conventions: &'static [Convention],
    },
    Material {
        width: usize,
        height: usize,
        lowest: f32,
        highest: f32,
        /// How many texels' fits ended in which way.
        fit: BTreeMap<&'static str, usize>,
        /// Samples that are no radiance and were left out, over all texels, of those that the fit was given.
        masked: u64,
        choice: Choice,
        lobes: usize,
        lpca: Option<Compressed>,
        paint: Option<Vec<Layer>>,
        provenance: Box<Provenance>,
        #[serde(serialize_with = "as_map")]
        conventions: &'static [Convention],
    },
}

/// What was measured: of a source, or of the source of a material.
#[derive(Serialize)]
struct Measured {
    samples: usize,
    every_pair: bool,
    /// Pairs of a view and a light that have no sample.
    missing: usize,
    /// The first of them, (θ, φ) of view and light in degrees; of a material they are not known.
    first_missing: Vec<[(f64, f64); 2]>,
    grid: Option<String>,
    encoding: Encoding,
    /// (θ, φ) in degrees.
    views: Vec<(f64, f64)>,
    /// (θ, φ) in degrees.
    lights: Vec<(f64, f64)>,
}

impl Measured {
    fn of_source(btf: &Btf) -> Self {
        let (views, lights) = (degrees(btf.views()), degrees(btf.lights()));
        Self {
            samples: btf.pairs().len(),
            every_pair: btf.is_product(),
            missing: btf.missing(),
            first_missing: btf.missing_pairs().take(LISTED_PAIRS).map(|pair| [views[pair.view], lights[pair.light]]).collect(),
            grid: btf.grid().map(str::to_owned),
            encoding: *btf.encoding(),
            views,
            lights,
        }
    }

    fn of_provenance(provenance: &Provenance) -> Self {
        let Provenance { views, lights, samples, grid, encoding, .. } = provenance;
        Self {
            samples: *samples,
            every_pair: *samples == views.len() * lights.len(),
            missing: (views.len() * lights.len()).saturating_sub(*samples),
            first_missing: Vec::new(),
            grid: grid.clone(),
            encoding: *encoding,
            views: degrees(views),
            lights: degrees(lights),
        }
    }
}

/// The local PCA of a material.
#[derive(Serialize)]
struct Compressed {
    #[serde(skip)]
    in_a_line: String,
    clusters: usize,
    components: usize,
    rank: usize,
    left_out: f64,
    relative_rms: f64,
    adapter_bytes: u64,
    stored_bytes: u64,
    /// The source's samples as halves.
    source_bytes: u64,
}

impl Compressed {
    fn of(lpca: &Lpca, stored_bytes: u64) -> Self {
        Self {
            in_a_line: lpca.to_string(),
            clusters: lpca.clusters,
            components: lpca.components,
            rank: lpca.learned.rank,
            left_out: lpca.learned.left_out,
            relative_rms: lpca.learned.relative_rms,
            adapter_bytes: lpca.bytes(),
            stored_bytes,
            source_bytes: lpca.source_bytes(),
        }
    }
}

/// As a material stores them.
fn as_map<S: Serializer>(conventions: &[Convention], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(conventions.iter().copied())
}

/// A layer of paint.
fn in_a_line(layer: &Layer) -> String {
    let Layer { paint, pattern, thickness, relief, refractive_index, roughness, .. } = layer;
    format!(
        "{}, {}, thickness {thickness}, relief {relief}, refractive index {refractive_index}, roughness {roughness}",
        paint.name,
        pattern.kind()
    )
}

/// How a texel's fit ended, in words.
fn fit_end(status: FitStatus) -> &'static str {
    match status {
        FitStatus::Running => "out of iterations",
        FitStatus::Converged => "converged",
        FitStatus::NoSpecular => "no specular part",
        FitStatus::Stalled => "settled to rounding",
        FitStatus::TooFewSamples => "too few valid samples",
        FitStatus::Shared => "with the representative texel's lobe",
    }
}

impl Content {
    fn of_source(btf: &Btf) -> Self {
        let [width, height] = btf.size();
        Self::Source { name: btf.name().to_owned(), width, height, measured: Measured::of_source(btf), conventions: conventions::SOURCE }
    }

    fn of_material(material: &Material, lpca_bytes: u64) -> Self {
        let [width, height] = material.size();
        let codes = material.fit.status.values();
        let texels = |status: FitStatus| codes.iter().filter(|&&code| FitStatus::from_code(code) == Some(status)).count();
        let heights = material.height.values().iter().copied();
        Self::Material {
            width,
            height,
            lowest: heights.clone().fold(f32::INFINITY, f32::min),
            highest: heights.fold(f32::NEG_INFINITY, f32::max),
            fit: FitStatus::ALL.map(|status| (fit_end(status), texels(status))).into(),
            masked: material.fit.masked.values().iter().copied().map(u64::from).sum(),
            choice: material.choice.clone(),
            lobes: material.svbrdf.lobes.len(),
            lpca: material.lpca.as_ref().map(|lpca| Compressed::of(lpca, lpca_bytes)),
            paint: material.painted.as_ref().map(|painted| painted.layers.clone()),
            provenance: Box::new(material.provenance.clone()),
            conventions: conventions::MATERIAL,
        }
    }

    fn describe(&self) -> String {
        let mut lines = Lines::default();
        let conventions = match self {
            Self::Source { name, width, height, measured, conventions } => {
                lines.add("source", name);
                lines.add("texels", format!("{width} x {height}"));
                lines.measured(measured);
                conventions
            }
            Self::Material { width, height, lowest, highest, fit, masked, choice, lobes, lpca, paint, provenance, conventions } => {
                lines.add("material of", &provenance.source);
                lines.add("texels", format!("{width} x {height}"));
                lines.add("height", format!("{lowest:.3} to {highest:.3} texel widths"));
                let ends: Vec<_> = fit.iter().filter(|(_, texels)| **texels > 0).map(|(end, texels)| format!("{texels} {end}")).collect();
                lines.add("fit", ends.join(", "));
                lines.add("surface", choice);
                lines.add("lobes", lobes);
                lines.compressed(lpca.as_ref());
                match paint.as_deref() {
                    None | Some([]) => lines.add("paint", "none"),
                    Some(layers) => lines.list("paint", layers.iter().map(in_a_line)),
                }
                lines.add("masked", format!("{masked} samples that are no radiance"));
                lines.measured(&Measured::of_provenance(provenance));
                lines.add("adapter", &provenance.adapter);
                lines.add("version", &provenance.version);
                // The settings by the names that they have in files.
                if let Ok(serde_json::Value::Object(settings)) = serde_json::to_value(provenance.settings) {
                    lines.list("settings", settings.iter().map(|(name, value)| format!("{name} = {value}")));
                }
                conventions
            }
        };
        lines.list("conventions", conventions.iter().map(|(topic, text)| format!("{topic}: {text}")));
        lines.0.join("\n")
    }
}

/// Lines for people: a label and what it labels.
#[derive(Default)]
struct Lines(Vec<String>);

impl Lines {
    fn add(&mut self, label: &str, text: impl Display) {
        self.0.push(format!("{label:13} {text}"));
    }

    /// One label for several lines.
    fn list(&mut self, label: &str, texts: impl Iterator<Item = String>) {
        for (index, text) in texts.enumerate() {
            self.add(if index == 0 { label } else { "" }, text);
        }
    }

    fn compressed(&mut self, lpca: Option<&Compressed>) {
        let Some(Compressed { in_a_line, stored_bytes, .. }) = lpca else { return self.add("local PCA", "none") };
        self.list("local PCA", [in_a_line.clone(), format!("{:.2} MB on disk", *stored_bytes as f64 / 1e6)].into_iter());
    }

    fn measured(&mut self, Measured { samples, every_pair, missing, first_missing, grid, encoding, views, lights }: &Measured) {
        self.add("views", rings(views));
        self.add("lights", rings(lights));
        self.add("samples", format!("{samples}{}", if *every_pair { ", every view under every light" } else { "" }));
        if *missing > 0 {
            self.add("missing", format!("{missing} of {} x {} pairs of a view and a light", views.len(), lights.len()));
        }
        self.list(
            "",
            first_missing.iter().map(|[view, light]| format!("view θ {} φ {}, light θ {} φ {}", view.0, view.1, light.0, light.1)),
        );
        if !first_missing.is_empty() && first_missing.len() < *missing {
            self.add("", "…");
        }
        self.add("grid", grid.as_deref().unwrap_or("none of the known ones"));
        let Encoding { transfer, includes_cosine, rows, scale, texels_per_mm } = encoding;
        let transfer = match transfer {
            Transfer::Srgb => "sRGB".to_owned(),
            Transfer::Gamma(gamma) => format!("gamma {gamma}"),
            Transfer::Linear => "linear".to_owned(),
        };
        self.add("transfer", transfer);
        self.add("cosine", if *includes_cosine { "in the stored values" } else { "not in the stored values, multiplied in" });
        let rows = match rows {
            RowOrder::TopDown => "top row first",
            RowOrder::BottomUp => "bottom row first",
        };
        self.add("rows", rows);
        self.add("scale", scale);
        if let Some(texels) = texels_per_mm {
            self.add("texels per mm", texels);
        }
    }
}

/// (θ, φ) in degrees, to a millionth: what a file's name says, without the noise of the conversion to radians and back.
fn degrees(directions: &[Direction]) -> Vec<(f64, f64)> {
    let rounded = |degrees: f64| (degrees * 1e6).round() / 1e6;
    directions.iter().map(|direction| direction.degrees()).map(|(theta, phi)| (rounded(theta), rounded(phi))).collect()
}

/// How many directions, and how many on each ring of equal θ; of many rings only the range.
fn rings(directions: &[(f64, f64)]) -> String {
    let mut rings: Vec<(f64, usize)> = Vec::new();
    for &(theta, _) in directions {
        match rings.iter_mut().find(|(ring, _)| *ring == theta) {
            Some((_, count)) => *count += 1,
            None => rings.push((theta, 1)),
        }
    }
    rings.sort_by(|a, b| a.0.total_cmp(&b.0));
    let on_rings = match rings.as_slice() {
        [] => return "0".to_owned(),
        [(lowest, _), .., (highest, _)] if rings.len() > LISTED_RINGS => format!("θ {lowest} to {highest}, {} different", rings.len()),
        _ => rings.iter().map(|(theta, count)| format!("{count} at θ {theta}")).collect::<Vec<_>>().join(", "),
    };
    format!("{}: {on_rings}", directions.len())
}
