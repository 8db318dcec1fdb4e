use std::fs;

use overpaint::{
    data::{Map, Material},
    io::material,
};

use super::{overpaint, refused};
use crate::support::material::{painted, sample};

crate::suite! { plain: both_forms_are_written_at_once, what_cannot_be_written_is_told_before_the_work, wrong_usage_is_refused; }

fn both_forms_are_written_at_once() {
    let folder = tempfile::tempdir().expect("is made");
    let mut sample = Material { painted: Some(painted([8, 5], 2)), ..sample([8, 5], 2) };
    // Three lobes of nothing, and a diffuse part that is no more than all.
    sample.svbrdf.diffuse = Map::from_fn(8, 5, |_, _| [0.5; 3]);
    material::save(&folder.path().join("m.zarr"), &sample).expect("saves");
    let ran = overpaint(folder.path(), &["export", "m.zarr", "--exr", "maps/", "--gltf", "m.gltf", "--mesh", "sphere", "--tiling", "2"]);
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
    assert!(ran.stdout.starts_with("wrote maps/\nwrote m.gltf, which does not hold all of the material:\n  relief"), "{}", ran.stdout);
    assert!(folder.path().join("maps/paint_coat.exr").is_file() && folder.path().join("maps/maps.json").is_file());
    let document = fs::read_to_string(folder.path().join("m.gltf")).expect("is there");
    assert!(document.starts_with('{') && document.contains("KHR_materials_specular"));
    // Again, over what is there; a mesh from a file, which is the one just written.
    let ran = overpaint(folder.path(), &["export", "m.zarr", "--exr", "maps", "--gltf", "m.glb", "--mesh", "m.gltf"]);
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
    assert!(fs::read(folder.path().join("m.glb")).expect("is there").starts_with(b"glTF"));
}

fn what_cannot_be_written_is_told_before_the_work() {
    let folder = tempfile::tempdir().expect("is made");
    fs::create_dir(folder.path().join("taken")).expect("is made");
    fs::write(folder.path().join("taken/notes.txt"), "mine").expect("is written");
    fs::create_dir(folder.path().join("a.glb")).expect("is made");
    // The material named here does not exist: the result is looked at first.
    let refuse = |arguments: &[&str], says: &str| refused(&overpaint(folder.path(), arguments), 1, says);
    refuse(&["export", "nowhere", "--exr", "taken"], "no overpaint export (no maps.json of one); choose another name");
    refuse(&["export", "nowhere", "--exr", "taken/notes.txt"], "it is there and no folder");
    refuse(&["export", "nowhere", "--exr", "no/such/maps"], "there is no folder no/such; make it first");
    refuse(&["export", "nowhere", "--gltf", "a.glb"], "it is a folder");
    refuse(&["export", "nowhere", "--gltf", "no/such.glb"], "there is no folder no; make it first");
    refuse(&["export", "nowhere", "--gltf", "b.glb", "--mesh", "none.obj"], "none.obj does not exist");
    refuse(&["export", "nowhere", "--gltf", "b.glb", "--mesh", "taken/notes.txt"], "a mesh must end in .obj, .gltf or .glb");
    refuse(&["export", "nowhere", "--gltf", "b.glb", "--exr", "maps"], "nowhere does not exist");
    assert!(!folder.path().join("maps").exists() && !folder.path().join("b.glb").exists());
}

fn wrong_usage_is_refused() {
    let folder = tempfile::tempdir().expect("is made");
    let refuse = |arguments: &[&str], says: &str| refused(&overpaint(folder.path(), arguments), 2, says);
    refuse(&["export", "m.zarr"], "  <--exr <DIR>|--gltf <FILE>>\n");
    refuse(&["export", "m.zarr", "--gltf", "m.obj"], "expected a name that ends in .glb (one binary file) or .gltf (one JSON file)");
    refuse(&["export", "m.zarr", "--exr", "maps", "--mesh", "sphere"], "  --gltf <FILE>\n");
    refuse(&["export", "m.zarr", "--exr", "maps", "--tiling", "2"], "  --gltf <FILE>\n");
    refuse(&["export", "m.zarr", "--gltf", "m.glb", "--tiling", "-1"], "expected a number above 0");
    refuse(&["export", "m.zarr", "--gltf", "m.glb", "--mesh", "cube"], "cube is neither a mesh of this program");
    refuse(&["export", "m.zarr", "--gltf", "m.glb", "--adapter", "x"], "leave them out here");
}
