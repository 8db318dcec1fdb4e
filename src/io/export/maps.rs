//! Maps of a material as OpenEXR, linear 32-bit floats, a file a map.
//!
//! | file | channels |
//! |---|---|
//! | `height` | `Y`, texel widths |
//! | `normal` | `R`, `G`, `B` = x, y, z, from -1 to 1 |
//! | `diffuse`; of each lobe `specular_1`, `specular_2`, … | `R`, `G`, `B` |
//! | of each lobe `lobe_1`, `lobe_2`, … | `Cx`, `Cy`, `Cz`, `n` |
//! | of paint `paint_height`, `paint_normal`, `paint_reflectance` | as those of the bare material |
//! | `paint_coverage` | `Y` |
//! | `paint_coat` | `F0`, `alpha` |
//!
//! Normals are not in channels X, Y and Z, which OpenEXR has for colours in CIE XYZ: readers would turn them into RGB. Each file says in
//! attributes what it holds, for it may go its own way; `maps.json` says it of all of them, with what belongs to no map, and marks the folder
//! as one that may be replaced.

use std::{fmt::Display, fs, io::Cursor, path::Path};

use exr::prelude::{AnyChannel, AnyChannels, AttributeValue, Encoding, FlatSamples, Image, Layer, LayerAttributes, Text, WritableImage};
use rayon::prelude::*;
use serde_json::{Value, json};

use crate::{
    data::{MAX_LOBES, Material},
    io::{
        IoError, conventions,
        material::format::{self, Layout},
        staging::Staging,
    },
};

/// The file that tells of the others.
const JSON: &str = "maps.json";

/// What [`JSON`] says that it is.
const FORMAT: &str = "overpaint maps";

const SOFTWARE: &str = concat!("overpaint ", env!("CARGO_PKG_VERSION"));

/// A map in the making.
struct Sheet<'a> {
    name: String,
    layout: &'static Layout,
    /// Channels and what is in them.
    channels: &'static [(&'static str, &'static str)],
    values: &'a [f32],
}

const SCALAR: &[(&str, &str)] = &[("Y", "value")];
const XYZ: &[(&str, &str)] = &[("R", "x"), ("G", "y"), ("B", "z")];
const RGB: &[(&str, &str)] = &[("R", "red"), ("G", "green"), ("B", "blue")];
const LOBE: &[(&str, &str)] = &[("Cx", "C_x"), ("Cy", "C_y"), ("Cz", "C_z"), ("n", "n")];
const COAT: &[(&str, &str)] = &[("F0", "F0"), ("alpha", "alpha")];

/// Checks that [`write_maps`] may put its folder at `path`: nothing is there, or an empty folder, or one that holds maps and nothing else.
///
/// # Errors
/// [`IoError::Occupied`] if something else stands there, [`IoError::Read`] if it cannot be looked at.
pub fn check_maps(path: &Path) -> Result<(), IoError> {
    let occupied = |found: String| Err(IoError::Occupied { path: path.to_owned(), found });
    match path.symlink_metadata() {
        Err(_) => return Ok(()),
        Ok(there) if !there.is_dir() => return occupied("it is there and no folder".to_owned()),
        Ok(_) => {}
    }
    let unreadable = |source| IoError::Read { file: path.display().to_string(), source };
    let entries = fs::read_dir(path).map_err(unreadable)?.map(|entry| entry.map(|entry| entry.path()));
    let entries = entries.collect::<Result<Vec<_>, _>>().map_err(unreadable)?;
    let index: Option<Value> = fs::read(path.join(JSON)).ok().and_then(|bytes| serde_json::from_slice(&bytes).ok());
    if !entries.is_empty() && index.is_none_or(|index| index["format"] != FORMAT) {
        return occupied(format!("it holds files and is no overpaint export (no {JSON} of one)"));
    }
    let names = names();
    let is_ours = |name: &str| name == JSON || name.strip_suffix(".exr").is_some_and(|name| names.iter().any(|ours| ours == name));
    match entries.iter().find(|entry| entry.is_dir() || !entry.file_name().and_then(|name| name.to_str()).is_some_and(is_ours)) {
        Some(foreign) => occupied(format!("it also holds {}, which is no map", foreign.display())),
        None => Ok(()),
    }
}

/// Writes the maps of `material` as the folder `path`, whole or not at all. Maps of an earlier export are replaced, all of them.
///
/// # Errors
/// [`IoError`] as of [`check_maps`], or if the system refuses to write.
pub fn write_maps(path: &Path, material: &Material) -> Result<(), IoError> {
    check_maps(path)?;
    let staging = Staging::beside(path)?;
    let folder = staging.path();
    let failed = |source| IoError::Write { path: path.to_owned(), source };
    fs::create_dir(&folder).map_err(failed)?;
    let sheets = sheets(material);
    sheets.par_iter().try_for_each(|sheet| {
        let bytes = sheet.exr(material.size()).map_err(|error| not_encoded(&path.join(sheet.file()), &error))?;
        fs::write(folder.join(sheet.file()), bytes).map_err(failed)
    })?;
    let index = serde_json::to_string_pretty(&index(material, &sheets)).map_err(|error| failed(error.into()))?;
    fs::write(folder.join(JSON), index).map_err(failed)?;
    staging.commit()
}

/// Names of all maps that a material may have.
fn names() -> Vec<String> {
    let fixed = [&format::HEIGHT, &format::NORMAL, &format::DIFFUSE, &format::PAINT_HEIGHT, &format::PAINT_NORMAL];
    let painted = [&format::PAINT_REFLECTANCE, &format::PAINT_COVERAGE, &format::PAINT_COAT];
    let lobes = (0..MAX_LOBES).flat_map(|index| [numbered(&format::SPECULAR[0], index), numbered(&format::LOBE[0], index)]);
    fixed.iter().chain(&painted).map(|layout| layout.name.to_owned()).chain(lobes).collect()
}

/// The name of the map of lobe `index`; all have their number.
fn numbered(layout: &Layout, index: usize) -> String {
    format!("{}_{}", layout.name, index + 1)
}

fn sheets(material: &Material) -> Vec<Sheet<'_>> {
    let mut sheets = vec![
        Sheet::new(&format::HEIGHT, SCALAR, material.height.values()),
        Sheet::new(&format::NORMAL, XYZ, material.normal.values().as_flattened()),
        Sheet::new(&format::DIFFUSE, RGB, material.svbrdf.diffuse.values().as_flattened()),
    ];
    for (index, lobe) in material.svbrdf.lobes.iter().enumerate().take(MAX_LOBES) {
        let specular = Sheet::new(&format::SPECULAR[0], RGB, lobe.specular.values().as_flattened());
        let parameters = Sheet::new(&format::LOBE[0], LOBE, lobe.parameters.values().as_flattened());
        sheets.extend([specular, parameters].map(|sheet| Sheet { name: numbered(sheet.layout, index), ..sheet }));
    }
    if let Some(painted) = &material.painted {
        sheets.extend([
            Sheet::new(&format::PAINT_HEIGHT, SCALAR, painted.height.values()),
            Sheet::new(&format::PAINT_NORMAL, XYZ, painted.normal.values().as_flattened()),
            Sheet::new(&format::PAINT_REFLECTANCE, RGB, painted.reflectance.values().as_flattened()),
            Sheet::new(&format::PAINT_COVERAGE, SCALAR, painted.coverage.values()),
            Sheet::new(&format::PAINT_COAT, COAT, painted.coat.values().as_flattened()),
        ]);
    }
    sheets
}

impl<'a> Sheet<'a> {
    fn new(layout: &'static Layout, channels: &'static [(&'static str, &'static str)], values: &'a [f32]) -> Self {
        Self { name: layout.name.to_owned(), layout, channels, values }
    }

    fn file(&self) -> String {
        format!("{}.exr", self.name)
    }

    /// The bytes of the file.
    fn exr(&self, [width, height]: [usize; 2]) -> Result<Vec<u8>, exr::error::Error> {
        let channel = |(index, (name, _)): (usize, &(&str, &str))| {
            let values = self.values.iter().skip(index).step_by(self.channels.len()).copied().collect();
            AnyChannel::new(*name, FlatSamples::F32(values))
        };
        let channels = AnyChannels::sort(self.channels.iter().enumerate().map(channel).collect());
        let in_channels: Vec<_> = self.channels.iter().map(|(name, what)| format!("{name} = {what}")).collect();
        let in_channels = in_channels.join(", ");
        let told = [("description", self.layout.about), ("unit", self.layout.unit), ("components", &in_channels)];
        let told = told.into_iter().chain(conventions::MATERIAL.iter().copied());
        let attributes = LayerAttributes {
            software_name: Text::new_or_none(SOFTWARE),
            comments: Text::new_or_none(format!("{}, in {}; {in_channels}", self.layout.about, self.layout.unit)),
            other: told
                .filter_map(|(name, text)| Some((Text::new_or_none(name)?, AttributeValue::Text(Text::new_or_none(text)?))))
                .collect(),
            ..LayerAttributes::default()
        };
        let layer = Layer::new((width, height), attributes, Encoding::SMALL_LOSSLESS, channels);
        let mut bytes = Cursor::new(Vec::new());
        Image::from_layer(layer).write().to_buffered(&mut bytes)?;
        Ok(bytes.into_inner())
    }
}

/// What [`JSON`] says.
fn index(material: &Material, sheets: &[Sheet<'_>]) -> Value {
    let [width, height] = material.size();
    let of_sheet = |sheet: &Sheet<'_>| {
        let channels: serde_json::Map<_, _> = sheet.channels.iter().map(|(name, what)| ((*name).to_owned(), json!(what))).collect();
        json!({"file": sheet.file(), "channels": channels, "unit": sheet.layout.unit, "description": sheet.layout.about})
    };
    json!({
        "format": FORMAT,
        "software": SOFTWARE,
        "source": material.provenance.source,
        "width": width,
        "height": height,
        "texels_per_mm": material.provenance.encoding.texels_per_mm,
        "frame": material.svbrdf.frame,
        "ambient": material.svbrdf.ambient,
        "conventions": conventions::MATERIAL.iter().copied().collect::<std::collections::BTreeMap<_, _>>(),
        "maps": sheets.iter().map(of_sheet).collect::<Vec<_>>(),
    })
}

fn not_encoded(path: &Path, error: &dyn Display) -> IoError {
    IoError::Picture { path: path.to_owned(), message: error.to_string() }
}
