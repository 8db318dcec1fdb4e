//! `overpaint paints`.

use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;

use super::{CliError, arguments, output, say, session::SessionArguments};
use crate::{
    io::{
        self,
        paints::{OwnPaint, Paints as OwnPaints},
    },
    model::{
        Paint,
        color::srgb_from_linear,
        kubelka_munk::opaque_reflectance,
        pigments::{self, Grade, Pigment, PigmentSet},
    },
    pipeline,
};

/// List the paints: Kubelka-Munk coefficients, colours, units and sources; or draw their swatches.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  overpaint paints\n  overpaint paints --library my_paints.toml --swatches swatches.png\n  overpaint paints --json"
)]
pub struct Paints {
    /// A file of own paints to list after those of the library
    #[arg(long, value_name = "FILE.toml")]
    library: Option<PathBuf>,
    /// Print JSON, coefficients to full precision
    #[arg(long)]
    json: bool,
    /// Paint each over black, white and a checker at several thicknesses, and write the sheet: .png (sRGB) or .exr (linear, 32-bit float)
    #[arg(long, value_name = "IMAGE", conflicts_with = "json", value_parser = arguments::image)]
    swatches: Option<PathBuf>,
}

impl Paints {
    /// Whether it computes.
    pub fn draws(&self) -> bool {
        self.swatches.is_some()
    }

    pub fn run(self, session: &SessionArguments) -> Result<(), CliError> {
        let own = self.library.as_deref().map(|path| io::paints::load(path).map(|paints| (path, paints))).transpose()?;
        if let Some(sheet) = self.swatches {
            let own = own.iter().flat_map(|(_, own)| own.own()).map(|own| own.paint.clone());
            let paints: Vec<_> = pigments::all().map(Paint::from).chain(own).collect();
            output::check_file(&sheet)?;
            let session = session.open()?;
            io::picture::write(&sheet, &pipeline::swatches(&session.gpu, &paints, &session.progress)?)?;
            session.finish()?;
            return Ok(());
        }
        let groups: Vec<_> =
            PigmentSet::ALL.into_iter().map(Group::of_set).chain(own.map(|(path, own)| Group::of_file(path, &own))).collect();
        let text = if self.json {
            let paints: Vec<_> = groups.into_iter().flat_map(|group| group.paints).collect();
            serde_json::to_string_pretty(&serde_json::json!({ "paints": paints }))
                .map_err(|error| CliError::Stdout { source: error.into() })?
        } else {
            let groups: Vec<_> = groups.iter().map(Group::describe).collect();
            let grades: Vec<_> = Grade::ALL.iter().map(|grade| format!("  {:9}  {}", grade.name(), grade.meaning())).collect();
            format!("{}\n\n{LEGEND}\n{}", groups.join("\n\n"), grades.join("\n"))
        };
        say(&text)
    }
}

const LEGEND: &str = "\
K and S are per unit of thickness, in red, green and blue. Colours are sRGB: opaque is of any thickness that hides the ground, on white of
thickness 1. Paints of different units do not mix. Substitutes stand for unpublished coefficients. Grades:";

/// Paints that are listed together.
struct Group {
    heading: String,
    paints: Vec<Listed>,
}

/// A paint as printed.
#[derive(Serialize)]
struct Listed {
    name: String,
    /// The file of an own paint.
    file: Option<PathBuf>,
    k: [f64; 3],
    s: [f64; 3],
    /// Linear reflectances of a coat that hides its ground.
    opaque: [f64; 3],
    opaque_srgb: String,
    /// Linear reflectances of thickness 1 on white.
    over_white: [f64; 3],
    over_white_srgb: String,
    grade: &'static str,
    substitute: bool,
    unit: Option<String>,
    source: Option<String>,
}

impl Group {
    fn of_set(set: PigmentSet) -> Self {
        let paints: Vec<_> = set.pigments().iter().map(Listed::of_pigment).collect();
        let substitutes = if paints.iter().any(|paint| paint.substitute) { " (substitutes)" } else { "" };
        Self { heading: format!("{}{substitutes}: {}", set.name(), set.unit()), paints }
    }

    fn of_file(path: &Path, own: &OwnPaints) -> Self {
        Self { heading: path.display().to_string(), paints: own.own().map(|own| Listed::of_own(path, own)).collect() }
    }

    fn describe(&self) -> String {
        let width = self.paints.iter().map(|paint| paint.name.chars().count()).max().unwrap_or_default();
        let mut lines = vec![
            self.heading.clone(),
            format!("  {:width$}  {:30}  {:30}  {:7}  {:8}  {:9}  source", "name", "K", "S", "opaque", "on white", "grade"),
        ];
        lines.extend(self.paints.iter().map(|paint| paint.describe(width)));
        lines.join("\n")
    }
}

impl Listed {
    fn new(Paint { name, k, s }: Paint) -> Self {
        let opaque = std::array::from_fn(|channel| opaque_reflectance(s[channel], k[channel]));
        let over_white = Paint { name: String::new(), k, s }.films(1.0).map(|film| film.over_substrate(1.0));
        let (opaque_srgb, over_white_srgb) = (hex(opaque), hex(over_white));
        let (file, grade, substitute, unit, source) = (None, "own", false, None, None);
        Self { name, file, k, s, opaque, opaque_srgb, over_white, over_white_srgb, grade, substitute, unit, source }
    }

    fn of_pigment(pigment: &Pigment) -> Self {
        let (unit, source) = (Some(pigment.set.unit().to_owned()), Some(pigment.source.to_owned()));
        let grade = pigment.grade;
        Self { grade: grade.name(), substitute: grade.is_substitute(), unit, source, ..Self::new(pigment.into()) }
    }

    fn of_own(path: &Path, OwnPaint { paint, unit, source }: &OwnPaint) -> Self {
        Self { file: Some(path.to_owned()), unit: unit.clone(), source: source.clone(), ..Self::new(paint.clone()) }
    }

    /// A line. The unit of the library stands above.
    fn describe(&self, width: usize) -> String {
        let three = |values: [f64; 3]| values.map(|value| format!("{:10}", digits(value))).concat();
        let unit = self.unit.as_ref().filter(|_| self.file.is_some()).map(|unit| format!("unit: {unit}"));
        let told: Vec<_> = [self.source.clone(), unit].into_iter().flatten().collect();
        let Self { name, k, s, opaque_srgb, over_white_srgb, grade, .. } = self;
        let line =
            format!("  {name:width$}  {}  {}  {opaque_srgb}  {over_white_srgb:8}  {grade:9}  {}", three(*k), three(*s), told.join("; "));
        line.trim_end().to_owned()
    }
}

/// A number of 0 or more to four digits.
fn digits(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let scale = 10_f64.powf(3.0 - value.log10().floor());
    ((value * scale).round() / scale).to_string()
}

/// `#rrggbb` of linear reflectances.
fn hex(linear: [f64; 3]) -> String {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "held to 0..=255 before")]
    let code = |value: f64| (255.0 * srgb_from_linear(value.clamp(0.0, 1.0))).round() as u8;
    let [r, g, b] = linear.map(code);
    format!("#{r:02x}{g:02x}{b:02x}")
}
