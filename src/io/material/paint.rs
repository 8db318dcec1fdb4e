//! The paint on a material on disk.

use serde_json::Value;

use super::{
    array::{Reader, Writer},
    format,
};
use crate::{
    data::Painted,
    io::IoError,
    model::{Layer, PaintMethod},
};

/// The group's attribute "paint".
#[derive(serde::Serialize, serde::Deserialize)]
pub(super) struct Attribute {
    method: PaintMethod,
    layers: Vec<Layer>,
    images: Vec<String>,
}

impl Attribute {
    pub(super) fn of(painted: &Painted) -> Self {
        Self { method: painted.method, layers: painted.layers.clone(), images: painted.images.clone() }
    }

    /// Reads it; null, or not there, where there is no paint.
    pub(super) fn read(attribute: &Value) -> Result<Option<Self>, String> {
        serde_json::from_value(attribute.clone()).map_err(|error| format!("cannot be read: {error}"))
    }
}

/// Writes the arrays.
pub(super) fn store(writer: &Writer, painted: &Painted) -> Result<(), IoError> {
    let Painted { height, normal, reflectance, coverage, coat, .. } = painted;
    writer.map(&format::PAINT_HEIGHT, height, height.values())?;
    writer.map(&format::PAINT_NORMAL, normal, normal.values().as_flattened())?;
    writer.map(&format::PAINT_REFLECTANCE, reflectance, reflectance.values().as_flattened())?;
    writer.map(&format::PAINT_COVERAGE, coverage, coverage.values())?;
    writer.map(&format::PAINT_COAT, coat, coat.values().as_flattened())
}

/// Reads the arrays.
pub(super) fn load(reader: &Reader, attribute: Attribute) -> Result<Painted, IoError> {
    let Attribute { method, layers, images } = attribute;
    Ok(Painted {
        method,
        layers,
        images,
        height: reader.scalars(&format::PAINT_HEIGHT)?,
        normal: reader.vectors(&format::PAINT_NORMAL)?,
        reflectance: reader.vectors(&format::PAINT_REFLECTANCE)?,
        coverage: reader.scalars(&format::PAINT_COVERAGE)?,
        coat: reader.vectors(&format::PAINT_COAT)?,
    })
}
