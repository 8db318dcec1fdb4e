//! Recipes: what is painted, as a TOML file.
//!
//! | key | what it is |
//! |---|---|
//! | `library` | a file of paints or an array of up to 16, beside the recipe or by paths from there ([own paints](super::paints)); default none |
//! | `canvas.repeat` | columns and rows in which the material is laid side by side below the paint, at most 4096 in all; default `[1, 1]` |
//! | `paints.NAME` | [own paints](super::paints) |
//! | `layer` | the layers, 1 to 256, **the bottom one first** |
//!
//! A layer:
//!
//! | key | what it is |
//! |---|---|
//! | `paint` | name of a paint, own or of the library (`overpaint paints` lists them); must be there |
//! | `thickness` | Kubelka-Munk d where the pattern is full, in the unit of the paint, 0 to 1e6; must be there |
//! | `pattern` | what is drawn: a kind, or a table of `kind` and its settings; default `"uniform"` |
//! | `placement` | where it is drawn, a table; default once, in the middle |
//! | `relief` | height in texel widths where the pattern is full, 0 to 1e6; default 0 |
//! | `refractive_index` | of the binder, 1 to 4; default 1.5 |
//! | `roughness` | width α of the surface's GGX lobe, 0.01 to 1; default 0.3 |
//!
//! A pattern draws a thickness from 0, bare, to 1, full, and two scales make it optical and geometric: **d = thickness · drawn, and the
//! surface rises by relief · drawn.** Patterns are drawn in cells, whose shorter edge is 1 long.
//!
//! | kind | settings |
//! |---|---|
//! | `uniform` | `drawn`, 0 to 1, default 1 |
//! | `image` | `file`, beside the recipe or by a path from there; `invert = true` where black is to be full, default `false` |
//! | `splash` | `seed` |
//! | `flower` | `seed`; `petals`, 3 to 16, default 6 |
//! | `brush` | `seed`; `width` of the stroke, 0.01 to 0.5, default 0.3 |
//! | `spatter` | `seed`; `cover`, the part of the cell that is covered, above 0 up to 0.9, default 0.3 |
//! | `stripes` | `count`, 1 to 1000, default 8; `width`, the part of their distance that is painted, above 0 and below 1, default 0.5 |
//! | `noise` | `seed`; `count` of the largest clouds along the shorter edge, 1 to 1000, default 8 |
//!
//! `seed` is a whole number from 0 to 4294967295, default 1. Images are PNG, TIFF and BMP of 8 or 16 bits, JPEG, TIFF of floating-point
//! numbers, Radiance HDR and OpenEXR, of 8192 x 8192 texels at most. Thickness is the code over the largest code, not decoded from sRGB,
//! of colours their luma (ITU-R BT.709), times the opacity if there is one; floating-point numbers are taken as they are and held to 0..=1.
//!
//! | key of `placement` | what it is |
//! |---|---|
//! | `tiling` | columns and rows of cells that the plane is divided into, each 1 to 1000; default `[1, 1]` |
//! | `offset` | right and up, in units of the cell's shorter edge; default `[0, 0]` |
//! | `rotation` | counter-clockwise, in degrees; default 0 |
//! | `size` | factor on the pattern's lengths, 0.001 to 4; default 1 |
//!
//! ```toml
//! library = "my_paints.toml"
//!
//! [canvas]
//! repeat = [2, 2]
//!
//! [paints.teal]
//! over_white = "#1d8f8a"
//! over_black = "rgb(10 60 58)"
//!
//! [[layer]]
//! paint = "oil/titanium white"
//! thickness = 2
//!
//! [[layer]]
//! paint = "teal"
//! pattern = { kind = "splash", seed = 3 }
//! placement = { tiling = [1, 1], offset = [0.1, 0], rotation = 30, size = 0.8 }
//! thickness = 4
//! relief = 1.5
//! refractive_index = 1.5
//! roughness = 0.3
//!
//! [[layer]]
//! paint = "oil/prussian blue"
//! pattern = { kind = "image", file = "leaf.png", invert = true }
//! thickness = 6
//! ```
//!
//! # Reading
//! The crate `toml` parses into tables in which each key and value knows its place (`DeTable`), and `document` reads those by hand. Its
//! other way, `serde` with `Spanned`, is less code here but loses the places where a value may have one of several forms, as patterns and
//! colours do. Colours are read by the crate `color`, which knows all of CSS Color 4 and does not clamp what lies outside sRGB.

mod color;
mod document;
mod error;
mod pattern;

use std::path::Path;

pub use error::{RecipeError, RecipeFault};

pub(super) use color::reflectances;
pub(super) use document::{Document, Outcome, Placed, Table, Value, read};
pub(super) use error::shortened;

use super::{
    IoError,
    paints::{self, Paints},
};
use crate::{
    data::Recipe,
    model::{Coat, Layer, PaintError, Pattern, Placement},
};
use pattern::{Images, pattern, placement};

/// The most layers.
const MAX_LAYERS: usize = 256;

/// The most pieces of the material side by side.
const MAX_PIECES: u32 = 4096;

/// The most files of paints.
const MAX_LIBRARIES: usize = 16;

/// Reads a recipe, and the files of paints and the images that it names.
///
/// # Errors
/// [`IoError::Recipe`] with file, line and column of what is wrong; others if the recipe itself cannot be read.
pub fn load(path: &Path) -> Result<Recipe, IoError> {
    let folder = path.parent().unwrap_or(Path::new(""));
    Ok(parse(&path.display().to_string(), &read(path)?, folder)?)
}

/// Reads the bytes of a recipe called `file`, whose names of other files start from `folder`.
///
/// # Errors
/// [`RecipeError`] with file, line and column of what is wrong.
pub fn parse(file: &str, bytes: &[u8], folder: &Path) -> Result<Recipe, RecipeError> {
    let document = Document::new(file, bytes)?;
    let entries = document.parse()?;
    let root = || Table::new("a recipe", 0..0, &entries).only(&["library", "canvas", "paints", "layer"]);
    let root = root().map_err(|placed| document.error(placed))?;
    let paints = paints(&root, folder).map_err(|fault| match fault {
        Unread::Here(placed) => document.error(placed),
        Unread::Elsewhere(error) => error,
    })?;
    recipe(&root, &paints, folder).map_err(|placed| document.error(placed))
}

/// What is wrong with paints.
enum Unread {
    /// In the recipe.
    Here(Placed),
    /// In a file of paints.
    Elsewhere(RecipeError),
}

impl From<Placed> for Unread {
    fn from(placed: Placed) -> Self {
        Self::Here(placed)
    }
}

/// The paints of the files that a recipe names, and its own.
fn paints(root: &Table<'_>, folder: &Path) -> Result<Paints, Unread> {
    let mut all = Paints::default();
    let files = match root.get("library") {
        None => Vec::new(),
        Some(file) if file.is_text() => vec![file],
        Some(files) => files.elements("the name of a file, or an array of such names")?,
    };
    if let Some(file) = files.get(MAX_LIBRARIES) {
        return Err(file.fault(RecipeFault::TooMany { found: files.len(), what: "files of paints", most: MAX_LIBRARIES }).into());
    }
    for file in files {
        let found = paints::load(&folder.join(file.path()?)).map_err(|error| match error {
            IoError::Recipe(error) => Unread::Elsewhere(error),
            error => file.fault(RecipeFault::File(Box::new(error))).into(),
        })?;
        all.add(found, file)?;
    }
    if let Some(tables) = root.get("paints") {
        all.add_tables(tables)?;
    }
    Ok(all)
}

fn recipe(root: &Table<'_>, paints: &Paints, folder: &Path) -> Outcome<Recipe> {
    let repeat = root.get("canvas").map_or(Ok([1, 1]), repeat)?;
    let mut images = Images::new(folder);
    let layers = match root.get("layer") {
        Some(layers) => layers.elements("an array of tables, each headed by [[layer]]")?,
        None => Vec::new(),
    };
    if layers.is_empty() {
        return Err(root.fault_at("layer", RecipeFault::NoLayers));
    }
    if let Some(value) = layers.get(MAX_LAYERS) {
        return Err(value.fault(RecipeFault::TooMany { found: layers.len(), what: "layers", most: MAX_LAYERS }));
    }
    let layers = layers.into_iter().map(|value| layer(value, paints, &mut images)).collect::<Outcome<_>>()?;
    Ok(Recipe { repeat, layers, images: images.into_inner() })
}

/// Columns and rows of the canvas.
fn repeat(canvas: Value<'_>) -> Outcome<[usize; 2]> {
    let canvas = canvas.table("the canvas")?.only(&["repeat"])?;
    let Some(repeat) = canvas.get("repeat") else { return Ok([1, 1]) };
    let [columns, rows] = repeat.array("two whole numbers, of columns and rows")?;
    let [columns, rows] = [columns.whole()?, rows.whole()?];
    if columns.checked_mul(rows).is_none_or(|pieces| !(1..=MAX_PIECES).contains(&pieces)) {
        return Err(repeat.fault(RecipeFault::Pieces { columns, rows, most: MAX_PIECES }));
    }
    Ok([columns as usize, rows as usize])
}

fn layer(value: Value<'_>, paints: &Paints, images: &mut Images<'_>) -> Outcome<Layer> {
    const KEYS: [&str; 7] = ["paint", "pattern", "placement", "thickness", "relief", "refractive_index", "roughness"];
    let table = value.table("a layer")?.only(&KEYS)?;
    let paint = table.need("paint", "paint = \"oil/cobalt blue\"")?;
    let paint = paints.find(paint.text()?).map_err(|error| paint.fault(error))?.paint();
    let coat = Coat::default();
    let layer = Layer {
        paint,
        thickness: table.need("thickness", "thickness = 4")?.number()?,
        relief: table.number("relief", 0.0)?,
        refractive_index: table.number("refractive_index", coat.refractive_index)?,
        roughness: table.number("roughness", coat.roughness)?,
        placement: table.get("placement").map_or(Ok(Placement::default()), placement)?,
        pattern: table.get("pattern").map_or(Ok(Pattern::Uniform { drawn: 1.0 }), |value| pattern(value, images))?,
    };
    layer.checked().map_err(|error| match error {
        PaintError::Setting { setting, .. } => table.fault_at(&setting.replace(' ', "_"), error),
        error => table.fault_at("paint", error),
    })
}
