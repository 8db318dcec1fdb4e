//! Whether a result can be written, asked before the work that leads to it.

use std::path::Path;

use super::CliError;
use crate::{io, pipeline};

/// Checks that a file of this path can be made: its folder is there and may be written, and it is no folder itself.
pub fn check_file(path: &Path) -> Result<(), CliError> {
    if path.is_dir() {
        return refuse(path, "it is a folder; name a file");
    }
    check_parent(path)
}

/// Checks that a material of this path can be made: nothing is in its place but an older material, and its folder may be written.
pub fn check_material(path: &Path) -> Result<(), CliError> {
    io::material::check_target(path)?;
    check_parent(path)
}

/// Checks that a dataset of this path can be made: nothing is in its place but an older dataset, and its folder may be written.
pub fn check_dataset(path: &Path) -> Result<(), CliError> {
    io::dataset::check_target(path)?;
    check_parent(path)
}

/// Checks that maps can be exported into this folder: nothing is in its place but older maps, and its parent may be written.
pub fn check_maps(path: &Path) -> Result<(), CliError> {
    io::export::check_maps(path)?;
    check_parent(path)
}

/// Checks that a comparison can be written into this folder: it is empty or holds an older comparison, and may be written, or it can be made.
pub fn check_comparison(path: &Path) -> Result<(), CliError> {
    pipeline::check_comparison(path)?;
    // A file of the folder stands for all, as far as it is there.
    if path.is_dir() { check_parent(&path.join("compare.json")) } else { check_parent(path) }
}

fn check_parent(path: &Path) -> Result<(), CliError> {
    let parent = match path.parent() {
        None => return refuse(path, "it names no file"),
        Some(parent) if parent.as_os_str().is_empty() => Path::new("."),
        Some(parent) => parent,
    };
    if !parent.is_dir() {
        return refuse(path, &format!("there is no folder {}; make it first", parent.display()));
    }
    match tempfile::tempfile_in(parent) {
        Ok(_) => Ok(()),
        Err(error) => refuse(path, &format!("the folder {} cannot be written ({error}); check its permissions", parent.display())),
    }
}

fn refuse(path: &Path, reason: &str) -> Result<(), CliError> {
    Err(CliError::Output { path: path.to_owned(), reason: reason.to_owned() })
}
