//! What is drawn and where.

use std::path::Path;

use toml::de::DeTable;

use super::{
    RecipeFault,
    document::{Outcome, Table, Value},
    error::shortened,
};
use crate::{
    data::{Map, PatternImage},
    io::raster,
    model::{Pattern, Placement},
};

/// The most texels of all images together: four of the largest.
const MAX_TEXELS: usize = 1 << 28;

/// Kinds of patterns and their keys.
const KINDS: [(&str, &[&str]); 8] = [
    ("uniform", &["kind", "drawn"]),
    ("image", &["kind", "file", "invert"]),
    ("splash", &["kind", "seed"]),
    ("flower", &["kind", "seed", "petals"]),
    ("brush", &["kind", "seed", "width"]),
    ("spatter", &["kind", "seed", "cover"]),
    ("stripes", &["kind", "count", "width"]),
    ("noise", &["kind", "seed", "count"]),
];

/// The images of a recipe, each read once.
pub(super) struct Images<'a> {
    /// Where their names start from.
    folder: &'a Path,
    images: Vec<(PatternImage, bool)>,
}

impl<'a> Images<'a> {
    pub(super) fn new(folder: &'a Path) -> Self {
        Self { folder, images: Vec::new() }
    }

    pub(super) fn into_inner(self) -> Vec<PatternImage> {
        self.images.into_iter().map(|(image, _)| image).collect()
    }

    /// The index of an image, black and white exchanged if `invert` is set.
    fn index(&mut self, file: Value<'_>, invert: bool) -> Outcome<usize> {
        let name = file.path()?;
        if let Some(index) = self.images.iter().position(|(image, inverted)| image.name == name && *inverted == invert) {
            return Ok(index);
        }
        let drawn = raster::drawing(&self.folder.join(name)).map_err(|error| file.fault(RecipeFault::File(Box::new(error))))?;
        let texels = self.images.iter().map(|(image, _)| image.drawn.values().len()).sum::<usize>() + drawn.values().len();
        if texels > MAX_TEXELS {
            return Err(file.fault(RecipeFault::TooMany { found: texels, what: "texels in all images together", most: MAX_TEXELS }));
        }
        let drawn: Map<f32> = if invert { drawn.map(|value| 1.0 - value) } else { drawn };
        self.images.push((PatternImage { name: name.to_owned(), drawn }, invert));
        Ok(self.images.len() - 1)
    }
}

/// A pattern by its kind alone, or as a table.
pub(super) fn pattern(value: Value<'_>, images: &mut Images<'_>) -> Outcome<Pattern> {
    let none = DeTable::new();
    let (kind, table) = if value.is_text() {
        (value, Table::new("the pattern", value.span(), &none))
    } else {
        let table = value.table("the pattern")?;
        (table.need("kind", "kind = \"splash\"")?, table)
    };
    let found = kind.text()?;
    let Some((name, keys)) = KINDS.into_iter().find(|(name, _)| *name == found) else {
        let known = KINDS.map(|(name, _)| name).join(", ");
        return Err(kind.fault(RecipeFault::Kind { found: shortened(found), known }));
    };
    let table = table.named(format!("a pattern of kind \"{name}\"")).only(keys)?;
    let seed = || table.whole("seed", 1);
    let pattern = match name {
        "image" => Pattern::Image { image: images.index(table.need("file", "file = \"leaf.png\"")?, table.flag("invert")?)? },
        "splash" => Pattern::Splash { seed: seed()? },
        "flower" => Pattern::Flower { seed: seed()?, petals: table.whole("petals", 6)? },
        "brush" => Pattern::Brush { seed: seed()?, width: table.number("width", 0.3)? },
        "spatter" => Pattern::Spatter { seed: seed()?, cover: table.number("cover", 0.3)? },
        "stripes" => Pattern::Stripes { count: table.whole("count", 8)?, width: table.number("width", 0.5)? },
        "noise" => Pattern::Noise { seed: seed()?, count: table.whole("count", 8)? },
        _ => Pattern::Uniform { drawn: table.number("drawn", 1.0)? },
    };
    pattern.checked().map_err(|error| table.fault_at(key(error.setting), error))
}

/// The key of what a pattern or placement calls a setting.
fn key(setting: &'static str) -> &'static str {
    match setting {
        "drawn thickness" => "drawn",
        "number of petals" => "petals",
        "covered part" => "cover",
        "number" | "number of clouds" => "count",
        "painted part" => "width",
        "number of columns" | "number of rows" => "tiling",
        setting => setting,
    }
}

/// Where a pattern is drawn.
pub(super) fn placement(value: Value<'_>) -> Outcome<Placement> {
    let table = value.table("the placement")?.only(&["tiling", "offset", "rotation", "size"])?;
    let default = Placement::default();
    let tiling = match table.get("tiling").map(|value| value.array("two whole numbers, of columns and rows")).transpose()? {
        Some([columns, rows]) => [columns.whole()?, rows.whole()?],
        None => default.tiling,
    };
    let offset = match table.get("offset").map(|value| value.array("two numbers, to the right and up")).transpose()? {
        Some([right, up]) => [right.number()?, up.number()?],
        None => default.offset,
    };
    let rotation = table.number("rotation", 0.0)?.to_radians();
    let placement = Placement { tiling, offset, rotation, size: table.number("size", default.size)? };
    placement.checked().map_err(|error| table.fault_at(key(error.setting), error))
}
