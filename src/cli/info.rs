//! `overpaint info`.

use std::{collections::BTreeMap, fmt::Write, path::PathBuf};

use clap::Args;
use serde::Serialize;

use super::{CliError, say};
use crate::{
    data::{Btf, Direction, FitStatus, Material, Provenance, Transfer},
    io,
};

/// Tell what a source or a material holds.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  overpaint info cloth.zip\n  overpaint info cloth.zarr --json")]
pub struct Info {
    /// A source (a folder or .zip of images) or a material
    path: PathBuf,
    /// Print JSON, every direction included
    #[arg(long)]
    json: bool,
}

impl Info {
    pub fn run(self) -> Result<(), CliError> {
        let content = match io::kind(&self.path) {
            io::Kind::Material => Content::of_material(&io::material::load(&self.path)?),
            // What is neither is refused by `open`, which says why.
            io::Kind::Source | io::Kind::Neither => Content::of_source(io::open(&self.path)?.btf()),
        };
        let text = if self.json {
            serde_json::to_string_pretty(&content).map_err(|error| CliError::Stdout { source: error.into() })?
        } else {
            content.describe()
        };
        say(&text)
    }
}

const SOURCE_CONVENTIONS: &[&str] = &[
    "row 0 is the top row; x right, y up, z out of the plane",
    "directions point away from the surface; theta from the normal, phi counter-clockwise from +x",
    "a pixel is pi L/E, E on a surface that faces the light: a white Lambertian plane lit at theta reads cos theta",
];

const MATERIAL_CONVENTIONS: &[&str] = &[
    "row 0 is the top row; x right, y up, z out of the plane",
    "directions point away from the surface; theta from the normal, phi counter-clockwise from +x",
    "linear RGB; reflectance as pi f_r: a white Lambertian plane is 1",
    "height in texel widths, positive outwards, mean 0",
];

/// What a path holds, as printed.
#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
enum Content {
    Source {
        name: String,
        width: usize,
        height: usize,
        samples: usize,
        every_pair: bool,
        grid: Option<&'static str>,
        transfer: Transfer,
        /// (θ, φ) in degrees.
        views: Vec<(f64, f64)>,
        /// (θ, φ) in degrees.
        lights: Vec<(f64, f64)>,
        conventions: &'static [&'static str],
    },
    Material {
        width: usize,
        height: usize,
        lowest: f32,
        highest: f32,
        /// How many texels' fits ended in which way.
        fit: BTreeMap<&'static str, usize>,
        provenance: Provenance,
        conventions: &'static [&'static str],
    },
}

/// How a texel's fit ended, in words.
fn fit_end(status: FitStatus) -> &'static str {
    match status {
        FitStatus::Running => "out of iterations",
        FitStatus::Converged => "converged",
        FitStatus::NoSpecular => "no specular part",
        FitStatus::Stalled => "stalled",
    }
}

impl Content {
    fn of_source(btf: &Btf) -> Self {
        let [width, height] = btf.size();
        let degrees = |directions: &[Direction]| directions.iter().map(|direction| rounded(*direction)).collect();
        Self::Source {
            name: btf.name().to_owned(),
            width,
            height,
            samples: btf.pairs().len(),
            every_pair: btf.is_product(),
            grid: btf.grid(),
            transfer: btf.transfer(),
            views: degrees(btf.views()),
            lights: degrees(btf.lights()),
            conventions: SOURCE_CONVENTIONS,
        }
    }

    fn of_material(material: &Material) -> Self {
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
            provenance: material.provenance.clone(),
            conventions: MATERIAL_CONVENTIONS,
        }
    }

    fn describe(&self) -> String {
        let mut lines = Vec::new();
        let mut line = |label: &str, text: String| lines.push(format!("{label:13} {text}"));
        let conventions = match self {
            Self::Source { name, width, height, samples, every_pair, grid, transfer, views, lights, conventions } => {
                line("source", name.clone());
                line("texels", format!("{width} x {height}"));
                line("views", rings(views));
                line("lights", rings(lights));
                line("samples", format!("{samples}{}", if *every_pair { ", every view under every light" } else { "" }));
                line("grid", grid.unwrap_or("none of the known ones").to_owned());
                let transfer = match transfer {
                    Transfer::Srgb => "sRGB",
                    Transfer::Linear => "linear",
                };
                line("transfer", transfer.to_owned());
                conventions
            }
            Self::Material { width, height, lowest, highest, fit, provenance, conventions } => {
                let Provenance { source, views, lights, samples, adapter, version, settings } = provenance;
                line("material of", source.clone());
                line("texels", format!("{width} x {height}"));
                line("height", format!("{lowest:.3} to {highest:.3} texel widths"));
                let ends: Vec<_> = fit.iter().filter(|(_, texels)| **texels > 0).map(|(end, texels)| format!("{texels} {end}")).collect();
                line("fit", ends.join(", "));
                line("measured", format!("{views} views, {lights} lights, {samples} samples"));
                line("adapter", adapter.clone());
                line("version", version.clone());
                // The settings by the names that they have in files.
                if let Ok(serde_json::Value::Object(settings)) = serde_json::to_value(settings) {
                    for (index, (name, value)) in settings.iter().enumerate() {
                        line(if index == 0 { "settings" } else { "" }, format!("{name} = {value}"));
                    }
                }
                conventions
            }
        };
        for (index, convention) in conventions.iter().enumerate() {
            line(if index == 0 { "conventions" } else { "" }, (*convention).to_owned());
        }
        lines.join("\n")
    }
}

/// (θ, φ) in degrees, to a millionth: what a file's name says, without the noise of the conversion to radians and back.
fn rounded(direction: Direction) -> (f64, f64) {
    let (theta, phi) = direction.degrees();
    ((theta * 1e6).round() / 1e6, (phi * 1e6).round() / 1e6)
}

/// How many directions, and how many on each ring of equal θ.
fn rings(directions: &[(f64, f64)]) -> String {
    let mut rings: Vec<(f64, usize)> = Vec::new();
    for &(theta, _) in directions {
        match rings.iter_mut().find(|(ring, _)| *ring == theta) {
            Some((_, count)) => *count += 1,
            None => rings.push((theta, 1)),
        }
    }
    rings.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut text = directions.len().to_string();
    for (index, (theta, count)) in rings.iter().enumerate() {
        let separator = if index == 0 { ": " } else { ", " };
        // Writing into a string cannot fail.
        write!(text, "{separator}{count} at θ {theta}").ok();
    }
    text
}
