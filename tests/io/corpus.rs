//! The seeds of the fuzz targets and what was found with them: none may panic, hang or ask for much memory.

use std::{
    path::{Path, PathBuf},
    time::{Duration, Instant},
};

#[path = "../fuzz/btf_file.rs"]
mod btf_file;
#[path = "../fuzz/image_name.rs"]
mod image_name;
#[path = "../fuzz/light_file.rs"]
mod light_file;
#[path = "../fuzz/recipe.rs"]
pub mod recipe;

crate::suite! { plain: containers, image_names, light_files, recipes; }

fn containers() {
    each("btf_file", btf_file::exercise);
}

fn image_names() {
    each("image_name", image_name::exercise);
}

fn light_files() {
    each("light_file", light_file::exercise);
}

fn recipes() {
    each("recipe", recipe::exercise);
}

/// Calls a target's function for every file of its corpus.
fn each(target: &str, exercise: fn(&[u8])) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fuzz/corpus").join(target);
    let mut files: Vec<PathBuf> = std::fs::read_dir(&folder).expect("is there").map(|entry| entry.expect("is readable").path()).collect();
    files.sort();
    assert!(files.len() >= 3, "{} holds only {} files", folder.display(), files.len());
    for file in files {
        let bytes = std::fs::read(&file).expect("is readable");
        let start = Instant::now();
        exercise(&bytes);
        // Files have some kilobytes at most: this is a hundred times what one takes on a busy machine.
        assert!(start.elapsed() < Duration::from_secs(5), "{} takes {:?}", file.display(), start.elapsed());
    }
}
