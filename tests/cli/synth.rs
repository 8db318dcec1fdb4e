//! Rendered sources, as a user makes and uses them.

use std::{fs, path::Path};

use overpaint::{gpu::Gpu, io};
use serde_json::Value;

use super::{overpaint, refused};

crate::suite! { gpu: a_tree_and_a_dataset_are_sources_with_their_truth, what_stands_in_the_way_is_left; }

fn synth(gpu: &Gpu, folder: &Path, arguments: &[&str]) -> String {
    let small = ["synth", "--adapter", &gpu.adapter().name, "--size", "24x16", "--views", "0:1,50:3", "--lights", "15:4,60:5"];
    let ran = overpaint(folder, &[&small, arguments].concat());
    assert_eq!(ran.code, Some(0), "{ran:?}");
    ran.stdout
}

fn info(folder: &Path, what: &str) -> Value {
    let ran = overpaint(folder, &["info", what, "--json"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    serde_json::from_str(&ran.stdout).expect("is JSON")
}

fn a_tree_and_a_dataset_are_sources_with_their_truth(gpu: &Gpu) {
    let folder = tempfile::tempdir().expect("is made");
    let folder = folder.path();
    let said = synth(gpu, folder, &["-o", "tree", "--tree", "exr", "--height-field", "bumps", "--reflectance", "plastic"]);
    assert!(said.contains("wrote tree and its truth, tree-truth.zarr"), "{said}");
    synth(gpu, folder, &["-o", "store.zarr", "--height-field", "bumps", "--reflectance", "plastic"]);
    for source in ["tree", "store.zarr"] {
        let told = info(folder, source);
        assert_eq!((&told["width"], &told["height"]), (&24.into(), &16.into()), "{told}");
        let material = format!("{source}.fit");
        let ran = overpaint(folder, &["fit", source, "-o", &material, "--adapter", &gpu.adapter().name]);
        assert_eq!(ran.code, Some(0), "{ran:?}");
    }
    // Linear halves and the dataset hold the same.
    let [tree, store] = ["tree", "store.zarr"].map(|source| io::open(&folder.join(source)).expect("opens"));
    for sample in [0, 17, 35] {
        assert_eq!(tree.picture(sample).expect("reads"), store.picture(sample).expect("reads"));
    }
    let [of_tree, of_store] = ["tree-truth.zarr", "store-truth.zarr"].map(|truth| io::material::load(&folder.join(truth)).expect("loads"));
    assert_eq!((&of_tree.height, &of_tree.svbrdf), (&of_store.height, &of_store.svbrdf));
    assert!(of_tree.provenance.source.contains("synthetic truth of plastic bumps"), "{}", of_tree.provenance.source);
}

fn what_stands_in_the_way_is_left(gpu: &Gpu) {
    let folder = tempfile::tempdir().expect("is made");
    fs::create_dir(folder.path().join("tree")).expect("is writable");
    fs::write(folder.path().join("tree/notes.txt"), "mine").expect("is writable");
    let adapter = &gpu.adapter().name;
    for arguments in [&["-o", "tree"][..], &["-o", "tree", "--tree", "png"]] {
        let small = ["synth", "--adapter", adapter, "--size", "8", "--views", "zenith", "--lights", "zenith"];
        refused(&overpaint(folder.path(), &[&small, arguments].concat()), 1, "is left as it is");
    }
    assert_eq!(fs::read(folder.path().join("tree/notes.txt")).expect("is there"), b"mine");
}
