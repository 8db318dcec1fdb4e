//! Recovered materials as Zarr v3 groups: one array a map, open, chunked, readable from Python.
//!
//! The group's own metadata are written last and the folder is renamed into place, so that a killed [`save`] leaves
//! nothing that [`load`] takes. Every chunk is stored, and gzip's checksum tells a damaged one; an absent chunk, which
//! Zarr reads as fill values, is an error here. [`load`] looks at nothing but the arrays that it knows; [`save`] does not
//! replace a group that holds anything else.

mod array;
pub(super) mod format;
mod lpca;
mod paint;

use std::{fmt::Display, path::Path, sync::Arc};

use serde_json::json;
use zarrs::{filesystem::FilesystemStore, group::GroupBuilder};

use array::{Reader, Writer, fault};
use format::Lengths;
pub use format::MATERIAL_FORMAT;

use super::{ArrayFault, IoError, conventions, group, staging::Staging};
use crate::{
    data::{Choice, Fit, FitStatus, Lobe, MAX_LOBES, Map, Material, Provenance, Svbrdf},
    model::Frame,
};

/// Writes `material` as the folder `path`. Another material there is replaced; anything else is left as it is.
///
/// # Errors
/// [`IoError`] if something else stands there, the maps do not cover one plane, or the system refuses to write.
pub fn save(path: &Path, material: &Material) -> Result<(), IoError> {
    check_target(path)?;
    let staging = Staging::beside(path)?;
    let new = staging.path();
    let store = Arc::new(FilesystemStore::new(&new).map_err(|error| not_written(path, &error))?);
    let writer = Writer { path, store: store.clone(), lengths: Lengths::of(material) };

    writer.map(&format::HEIGHT, &material.height, material.height.values())?;
    writer.map(&format::NORMAL, &material.normal, material.normal.values().as_flattened())?;
    writer.map(&format::NORMAL_MEASURED, &material.normal_measured, material.normal_measured.values().as_flattened())?;
    writer.map(&format::ALBEDO, &material.albedo, material.albedo.values())?;
    let Svbrdf { frame, ambient, diffuse, lobes } = &material.svbrdf;
    writer.map(&format::DIFFUSE, diffuse, diffuse.values().as_flattened())?;
    for (index, Lobe { specular, parameters }) in lobes.iter().enumerate().take(MAX_LOBES) {
        writer.map(&format::SPECULAR[index], specular, specular.values().as_flattened())?;
        writer.map(&format::LOBE[index], parameters, parameters.values().as_flattened())?;
    }
    let Fit { objective_without_lobe, objective, iterations, status, masked } = &material.fit;
    writer.map(&format::OBJECTIVE_WITHOUT_LOBE, objective_without_lobe, objective_without_lobe.values())?;
    writer.map(&format::OBJECTIVE, objective, objective.values())?;
    writer.map(&format::ITERATIONS, iterations, iterations.values())?;
    let codes: Vec<u8> = status.values().iter().map(|&code| status_code(path, code)).collect::<Result<_, _>>()?;
    writer.map(&format::STATUS, status, &codes)?;
    writer.map(&format::MASKED, masked, masked.values())?;
    if let Some(lpca) = &material.lpca {
        lpca::store(&writer, lpca, &material.provenance)?;
    }
    if let Some(painted) = &material.painted {
        paint::store(&writer, painted)?;
    }

    let [width, height] = material.size();
    let provenance = serde_json::to_value(&material.provenance).map_err(|error| not_written(path, &error))?;
    let attributes = [
        ("format", json!(MATERIAL_FORMAT)),
        ("format_version", json!(format::VERSION)),
        ("width", json!(width)),
        ("height", json!(height)),
        ("frame", json!(frame)),
        ("ambient", json!(ambient)),
        ("choice", json!(material.choice)),
        ("lobes", json!(lobes.len())),
        ("lpca", json!(material.lpca.as_ref().map(lpca::Attribute::of))),
        ("paint", json!(material.painted.as_ref().map(paint::Attribute::of))),
        ("conventions", conventions::MATERIAL.iter().copied().collect()),
        ("provenance", provenance),
    ];
    let mut group = GroupBuilder::new();
    group.attributes(attributes.into_iter().map(|(name, value)| (name.to_owned(), value)).collect());
    let group = group.build(store, "/").map_err(|error| not_written(path, &error))?;
    group.store_metadata().map_err(|error| not_written(path, &error))?;
    staging.commit()
}

/// Reads the material in folder `path`.
///
/// # Errors
/// [`IoError`] if there is no material, its version is another, or an array is missing, damaged, or of another type or
/// shape than the format has it.
pub fn load(path: &Path) -> Result<Material, IoError> {
    if !path.exists() {
        return Err(IoError::NotFound { path: path.to_owned() });
    }
    let not_a_material = |found: String| IoError::NotAMaterial { path: path.to_owned(), found };
    let attributes = group::attributes(path, MATERIAL_FORMAT).map_err(not_a_material)?;
    let version = &attributes["format_version"];
    if !version.as_u64().is_some_and(|version| format::READ_VERSIONS.contains(&version)) {
        return Err(IoError::Version { path: path.to_owned(), what: "material", found: version.to_string(), expected: format::VERSION });
    }
    let side = |name: &str| {
        let side = attributes[name].as_u64().and_then(|side| usize::try_from(side).ok()).filter(|&side| side > 0);
        side.ok_or_else(|| not_a_material(format!("its attribute \"{name}\" is {}", attributes[name])))
    };
    let plane @ [width, height] = [side("width")?, side("height")?];
    let frame: Frame = serde_json::from_value(attributes["frame"].clone())
        .map_err(|error| not_a_material(format!("its attribute \"frame\" cannot be read: {error}")))?;
    let choice: Choice = serde_json::from_value(attributes["choice"].clone())
        .map_err(|error| not_a_material(format!("its attribute \"choice\" cannot be read: {error}")))?;
    let ambient = attributes["ambient"].as_f64().filter(|ambient| (0.0..=1.0).contains(ambient));
    let ambient = ambient.ok_or_else(|| not_a_material(format!("its attribute \"ambient\" is {}", attributes["ambient"])))?;
    let lobes = attributes["lobes"].as_u64().and_then(|lobes| usize::try_from(lobes).ok()).filter(|lobes| (1..=MAX_LOBES).contains(lobes));
    let lobes = lobes.ok_or_else(|| not_a_material(format!("its attribute \"lobes\" is {}", attributes["lobes"])))?;
    let provenance: Provenance = serde_json::from_value(attributes["provenance"].clone())
        .map_err(|error| not_a_material(format!("its attribute \"provenance\" cannot be read: {error}")))?;

    let lpca = lpca::Attribute::read(&attributes["lpca"]).map_err(|found| not_a_material(format!("its attribute \"lpca\" {found}")))?;
    let paint = paint::Attribute::read(&attributes["paint"]).map_err(|found| not_a_material(format!("its attribute \"paint\" {found}")))?;

    let store = Arc::new(FilesystemStore::new(path).map_err(|error| not_a_material(error.to_string()))?);
    let lengths = lpca.as_ref().map_or(Lengths { plane, samples: 0, clusters: 0, components: 0 }, |lpca| lpca.lengths(plane));
    let reader = Reader { path, store, lengths };
    let lobe =
        |index: usize| Ok(Lobe { specular: reader.vectors(&format::SPECULAR[index])?, parameters: reader.vectors(&format::LOBE[index])? });
    let lobes = (0..lobes).map(lobe).collect::<Result<_, IoError>>()?;
    let status: Vec<u8> = reader.values(&format::STATUS)?;
    let status: Vec<u32> = status.into_iter().map(u32::from).collect();
    for &code in &status {
        status_code(path, code)?;
    }
    Ok(Material {
        height: reader.scalars(&format::HEIGHT)?,
        normal: reader.vectors(&format::NORMAL)?,
        normal_measured: reader.vectors(&format::NORMAL_MEASURED)?,
        albedo: reader.scalars(&format::ALBEDO)?,
        svbrdf: Svbrdf { frame, ambient, diffuse: reader.vectors(&format::DIFFUSE)?, lobes },
        lpca: lpca.map(|attribute| lpca::load(&reader, attribute, &provenance)).transpose()?,
        painted: paint.map(|attribute| paint::load(&reader, attribute)).transpose()?,
        fit: Fit {
            objective_without_lobe: reader.scalars(&format::OBJECTIVE_WITHOUT_LOBE)?,
            objective: reader.scalars(&format::OBJECTIVE)?,
            iterations: reader.scalars(&format::ITERATIONS)?,
            status: Map::new(width, height, status)?,
            masked: reader.scalars(&format::MASKED)?,
        },
        choice,
        provenance,
    })
}

/// Whether `path` is a folder that says that it is a material, of whatever version.
pub(super) fn is_material(path: &Path) -> bool {
    group::attributes(path, MATERIAL_FORMAT).is_ok()
}

/// Checks that [`save`] may put a material at `path`: nothing is there, or a folder that holds a material and nothing else. [`save`]
/// asks the same; whoever computes for long before it can ask first.
///
/// # Errors
/// [`IoError::Occupied`] if something else stands there, [`IoError::Read`] if it cannot be looked at.
pub fn check_target(path: &Path) -> Result<(), IoError> {
    group::check_target(path, MATERIAL_FORMAT, "material", &format::NAMES)
}

/// Bytes that the local PCA of the material in folder `path` takes on disk; 0 without one.
///
/// # Errors
/// [`IoError::Read`] if the system refuses to tell.
pub fn lpca_bytes(path: &Path) -> Result<u64, IoError> {
    let folders = format::LPCA_NAMES.map(|name| path.join(name));
    folders.iter().filter(|folder| folder.is_dir()).map(|folder| bytes_in(folder)).sum()
}

/// Bytes of all files in `folder` and the folders in it.
fn bytes_in(folder: &Path) -> Result<u64, IoError> {
    let unreadable = |source| IoError::Read { file: folder.display().to_string(), source };
    let bytes = |entry: std::io::Result<std::fs::DirEntry>| {
        let entry = entry.map_err(unreadable)?;
        let metadata = entry.metadata().map_err(unreadable)?;
        if metadata.is_dir() { bytes_in(&entry.path()) } else { Ok(metadata.len()) }
    };
    std::fs::read_dir(folder).map_err(unreadable)?.map(bytes).sum()
}

fn status_code(path: &Path, code: u32) -> Result<u8, IoError> {
    let known = FitStatus::from_code(code).map(|status| status as u8);
    let codes = 0..FitStatus::ALL.len();
    let unknown = || ArrayFault::Unexpected { what: "codes", expected: format!("{codes:?}"), found: code.to_string() };
    known.ok_or_else(|| fault(path, &format::STATUS, unknown()))
}

fn not_written(path: &Path, error: &dyn Display) -> IoError {
    IoError::Write { path: path.to_owned(), source: std::io::Error::other(error.to_string()) }
}
