//! What the Zarr groups of this program have in common: materials and datasets tell themselves by an attribute of their group.

use std::{fs::File, io::Read, path::Path};

use serde_json::Value;

use super::IoError;

/// Metadata of a group are far smaller; whatever is larger is none of ours.
const MAX_METADATA_BYTES: u64 = 1 << 24;

/// The attributes of the group of form `format` in folder `path`, or what it is instead.
pub(super) fn attributes(path: &Path, format: &str) -> Result<Value, String> {
    let name = path.join("zarr.json");
    let mut text = String::new();
    let file = File::open(&name).map_err(|_| "it holds no zarr.json".to_owned())?;
    file.take(MAX_METADATA_BYTES).read_to_string(&mut text).map_err(|error| format!("its zarr.json cannot be read: {error}"))?;
    let mut metadata: Value = serde_json::from_str(&text).map_err(|error| format!("its zarr.json cannot be read: {error}"))?;
    if metadata["zarr_format"] != 3 || metadata["node_type"] != "group" {
        return Err("its zarr.json is not that of a Zarr v3 group".to_owned());
    }
    let attributes = metadata["attributes"].take();
    if attributes["format"] == format { Ok(attributes) } else { Err(format!("its attribute \"format\" is {}", attributes["format"])) }
}

/// Checks that a group of form `format` may be put at `path`: nothing is there, or a folder that holds one with arrays of the given names
/// and nothing else. `what` names the form for people.
pub(super) fn check_target(path: &Path, format: &str, what: &str, arrays: &[&str]) -> Result<(), IoError> {
    let occupied = |found: String| Err(IoError::Occupied { path: path.to_owned(), found });
    if path.symlink_metadata().is_err() {
        return Ok(());
    }
    if path.is_symlink() {
        return occupied("it is a link".to_owned());
    }
    if let Err(found) = attributes(path, format) {
        return occupied(format!("it is there and no overpaint {what} ({found})"));
    }
    // Replacing removes the folder: nothing may be lost but what was written as such a group.
    let unreadable = |source| IoError::Read { file: path.display().to_string(), source };
    let ours = |file: &Path| {
        let mut parts = file.iter().map(|part| part.to_str().unwrap_or_default());
        match (parts.next(), parts.next()) {
            (Some("zarr.json"), None) => true,
            (Some(array), None | Some("zarr.json" | "c")) => arrays.contains(&array),
            _ => false,
        }
    };
    for entry in std::fs::read_dir(path).map_err(unreadable)? {
        let entry = entry.map_err(unreadable)?.path();
        let inner =
            if entry.is_dir() { std::fs::read_dir(&entry).map_err(unreadable)?.collect::<Result<Vec<_>, _>>() } else { Ok(Vec::new()) };
        let inner = inner.map_err(unreadable)?.into_iter().map(|inner| inner.path());
        if let Some(foreign) = inner.chain([entry]).find(|file| !file.strip_prefix(path).is_ok_and(ours)) {
            return occupied(format!("it also holds {}, which is no part of a {what}", foreign.display()));
        }
    }
    Ok(())
}
