//! Folders, compared byte for byte.

use std::{
    fs,
    path::{Path, PathBuf},
};

/// All files of a folder with their contents.
pub fn files(path: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut found = Vec::new();
    let mut folders = vec![path.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("is there") {
            let entry = entry.expect("is readable").path();
            if entry.is_dir() {
                folders.push(entry);
            } else {
                let bytes = fs::read(&entry).expect("is readable");
                found.push((entry.strip_prefix(path).expect("is below").to_owned(), bytes));
            }
        }
    }
    found.sort();
    found
}
