//! The paint of a material on disk.

use overpaint::{
    data::{Map, Material, Painted},
    io::material,
    model::PaintMethod,
};

use super::{
    assert_says,
    material::{bits, saved},
};
use crate::support::material::{painted, sample};

crate::suite! { plain:
    paint_comes_back_bit_by_bit,
    paint_of_another_plane_is_not_saved,
    damaged_paint_is_named,
    a_material_from_before_there_was_paint_is_read;
}

fn coated(size: [usize; 2]) -> Material {
    Material { painted: Some(painted(size, 5)), ..sample(size, 3) }
}

fn paint_comes_back_bit_by_bit() {
    for size in [[1, 1], [7, 5], [300, 257]] {
        for method in [PaintMethod::KubelkaMunk, PaintMethod::AlphaBlend] {
            let material = Material { painted: Some(Painted { method, ..painted(size, 5) }), ..sample(size, 3) };
            let (_folder, path) = saved(&material);
            let loaded = material::load(&path).expect("loads");
            assert_eq!(loaded.painted, material.painted);
            assert_eq!(bits(&loaded), bits(&material));
        }
    }
    // Bare again, and nothing is left of the paint.
    let (_folder, path) = saved(&coated([7, 5]));
    material::save(&path, &sample([7, 5], 3)).expect("replaces it");
    assert_eq!(material::load(&path).expect("loads").painted, None);
    assert!(!path.join("paint_height").exists());
}

fn paint_of_another_plane_is_not_saved() {
    let folder = tempfile::tempdir().expect("is made");
    let mut material = coated([7, 5]);
    material.painted.as_mut().expect("is there").coverage = Map::from_fn(5, 7, |_, _| 0.0);
    assert_says(material::save(&folder.path().join("cloth.zarr"), &material), &["7"]);
}

fn damaged_paint_is_named() {
    let (_folder, path) = saved(&coated([7, 5]));
    for name in ["paint_height", "paint_normal", "paint_reflectance", "paint_coverage", "paint_coat"] {
        let moved = path.with_extension("moved");
        std::fs::rename(path.join(name), &moved).expect("is there");
        assert_says(material::load(&path), &[&format!("array \"{name}\""), "cloth.zarr"]);
        std::fs::rename(&moved, path.join(name)).expect("is there");
    }
    let group = path.join("zarr.json");
    let text = std::fs::read_to_string(&group).expect("is there");
    for (good, bad) in [("\"kubelka-munk\"", "\"varnish\""), ("\"splash\"", "\"smear\""), ("\"images\"", "\"pictures\"")] {
        assert!(text.contains(good), "{good}");
        std::fs::write(&group, text.replace(good, bad)).expect("is writable");
        assert_says(material::load(&path), &["its attribute \"paint\" cannot be read"]);
    }
}

fn a_material_from_before_there_was_paint_is_read() {
    let (_folder, path) = saved(&sample([4, 4], 1));
    let group = path.join("zarr.json");
    let mut json: serde_json::Value = serde_json::from_slice(&std::fs::read(&group).expect("is there")).expect("is JSON");
    let attributes = json["attributes"].as_object_mut().expect("are there");
    attributes.insert("format_version".to_owned(), 3.into());
    attributes.remove("paint");
    std::fs::write(&group, json.to_string()).expect("is writable");
    assert_eq!(material::load(&path).expect("loads").painted, None);
}
