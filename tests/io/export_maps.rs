//! Maps as a folder of OpenEXR files.

use std::{collections::BTreeMap, fs, path::Path};

use exr::prelude::{AttributeValue, FlatSamples, ReadChannels, ReadLayers, Text, read};
use overpaint::{
    data::Material,
    io::{export, picture},
};
use serde_json::Value;

use super::assert_says;
use crate::support::{
    files::files,
    material::{painted, sample},
};

crate::suite! { plain:
    every_bit_comes_back_under_its_channel,
    maps_say_what_they_hold,
    maps_replace_maps_and_nothing_else;
}

fn painted_sample(size: [usize; 2], seed: u64) -> Material {
    Material { painted: Some(painted(size, seed)), ..sample(size, seed) }
}

type ByName<T> = BTreeMap<String, T>;

/// Bits of each channel, the attributes that are texts, and the size.
fn channels(path: &Path) -> (ByName<Vec<u32>>, ByName<String>, [usize; 2]) {
    let image = read().no_deep_data().largest_resolution_level().all_channels().first_valid_layer().all_attributes().from_file(path);
    let layer = image.expect("is OpenEXR").layer_data;
    let bits = |samples: FlatSamples| match samples {
        FlatSamples::F32(values) => values.iter().map(|value| value.to_bits()).collect(),
        other => panic!("{other:?}"),
    };
    let attributes = layer.attributes.other.iter().filter_map(|(name, value)| match value {
        AttributeValue::Text(text) => Some((name.to_string(), text.to_string())),
        _ => None,
    });
    let mut attributes: BTreeMap<_, _> = attributes.collect();
    let mut told = |name: &str, text: Option<Text>| attributes.insert(name.to_owned(), text.expect("is told").to_string());
    told("software", layer.attributes.software_name.clone());
    told("comments", layer.attributes.comments.clone());
    let size = [layer.size.0, layer.size.1];
    (layer.channel_data.list.into_iter().map(|channel| (channel.name.to_string(), bits(channel.sample_data))).collect(), attributes, size)
}

fn every_bit_comes_back_under_its_channel() {
    let folder = tempfile::tempdir().expect("is made");
    let path = folder.path().join("maps");
    // Three lobes; a number below the normal ones is in the height.
    let material = painted_sample([11, 6], 3);
    assert_eq!(material.svbrdf.lobes.len(), 3);
    export::write_maps(&path, &material).expect("writes");
    let paint = material.painted.as_ref().expect("is painted");
    let mut expected: ByName<(Vec<&str>, &[f32])> = BTreeMap::new();
    let mut add = |name: &str, channels: &[&'static str], values| expected.insert(format!("{name}.exr"), (channels.to_vec(), values));
    add("height", &["Y"], material.height.values());
    add("normal", &["R", "G", "B"], material.normal.values().as_flattened());
    add("diffuse", &["R", "G", "B"], material.svbrdf.diffuse.values().as_flattened());
    for (index, lobe) in material.svbrdf.lobes.iter().enumerate() {
        add(&format!("specular_{}", index + 1), &["R", "G", "B"], lobe.specular.values().as_flattened());
        add(&format!("lobe_{}", index + 1), &["Cx", "Cy", "Cz", "n"], lobe.parameters.values().as_flattened());
    }
    add("paint_height", &["Y"], paint.height.values());
    add("paint_normal", &["R", "G", "B"], paint.normal.values().as_flattened());
    add("paint_reflectance", &["R", "G", "B"], paint.reflectance.values().as_flattened());
    add("paint_coverage", &["Y"], paint.coverage.values());
    add("paint_coat", &["F0", "alpha"], paint.coat.values().as_flattened());

    let mut found: Vec<_> = files(&path).into_iter().map(|(name, _)| name.display().to_string()).collect();
    found.retain(|name| name != "maps.json");
    assert_eq!(found, expected.keys().cloned().collect::<Vec<_>>());
    for (name, (names, values)) in expected {
        let (found, _, size) = channels(&path.join(&name));
        assert_eq!(size, [11, 6], "{name}");
        assert_eq!(found.len(), names.len(), "{name}");
        for (index, channel) in names.iter().enumerate() {
            let bits: Vec<_> = values.iter().skip(index).step_by(names.len()).map(|value| value.to_bits()).collect();
            assert_eq!(found[*channel], bits, "{channel} of {name}");
        }
    }
    // As a picture, by the reader that is there for pictures: row 0 is the top row.
    let diffuse = picture::read(&path.join("diffuse.exr")).expect("is a picture");
    assert_eq!(diffuse[(4, 1)][..3], material.svbrdf.diffuse[(4, 1)]);
}

fn maps_say_what_they_hold() {
    let folder = tempfile::tempdir().expect("is made");
    let path = folder.path().join("maps");
    let material = painted_sample([4, 3], 5);
    export::write_maps(&path, &material).expect("writes");
    let (_, told, _) = channels(&path.join("normal.exr"));
    assert_eq!(told["components"], "R = x, G = y, B = z");
    assert_eq!(told["axes"], "x right, y up, z out of the surface; directions point away from the surface");
    assert_eq!(told["rows"], "row 0 is the top row, column 0 the left column");
    assert_eq!(told["comments"], "unit normals of the height field, in 1; R = x, G = y, B = z");
    assert_eq!(told["software"], concat!("overpaint ", env!("CARGO_PKG_VERSION")));
    assert_eq!(channels(&path.join("height.exr")).1["unit"], "texel widths");

    let index: Value = serde_json::from_slice(&fs::read(path.join("maps.json")).expect("is there")).expect("is JSON");
    assert_eq!((&index["source"], &index["frame"], &index["ambient"]), (&"a \"sample\", θ".into(), &"seen".into(), &(0.1 + 0.2).into()));
    let maps = index["maps"].as_array().expect("is a list");
    let mut listed: Vec<_> = maps.iter().map(|map| map["file"].as_str().expect("is a name").to_owned()).collect();
    listed.sort();
    let found = files(&path).into_iter().map(|(name, _)| name.display().to_string()).filter(|name| name != "maps.json");
    assert_eq!(listed, found.collect::<Vec<_>>());
    let lobe = maps.iter().find(|map| map["file"] == "lobe_2.exr").expect("is listed");
    assert_eq!((&lobe["channels"]["Cx"], &lobe["channels"]["n"], &lobe["unit"]), (&"C_x".into(), &"n".into(), &"1".into()));
}

fn maps_replace_maps_and_nothing_else() {
    let folder = tempfile::tempdir().expect("is made");
    let path = folder.path().join("maps");
    let bare = Material { painted: None, ..sample([3, 3], 9) };
    // An empty folder may be there; what an export leaves out does not outlive it.
    fs::create_dir(&path).expect("is made");
    export::write_maps(&path, &painted_sample([5, 5], 9)).expect("writes");
    assert!(path.join("paint_coat.exr").exists() && path.join("lobe_3.exr").exists());
    export::write_maps(&path, &bare).expect("writes");
    let expected = ["diffuse.exr", "height.exr", "lobe_1.exr", "maps.json", "normal.exr", "specular_1.exr"];
    assert_eq!(files(&path).iter().map(|(name, _)| name.display().to_string()).collect::<Vec<_>>(), expected);
    assert_eq!(fs::read_dir(folder.path()).expect("is there").count(), 1, "nothing is left beside it");

    fs::write(path.join("notes.txt"), "mine").expect("is written");
    assert_says(export::write_maps(&path, &bare), &["left as it is", "notes.txt", "which is no map"]);
    fs::remove_file(path.join("notes.txt")).expect("is there");
    fs::create_dir(path.join("height_2.exr")).expect("is made");
    assert_says(export::check_maps(&path), &["height_2.exr", "which is no map"]);

    let other = folder.path().join("other");
    fs::create_dir(&other).expect("is made");
    fs::write(other.join("height.exr"), "mine").expect("is written");
    assert_says(export::write_maps(&other, &bare), &["other", "no maps.json of one", "choose another name"]);
    assert_says(export::write_maps(&other.join("height.exr"), &bare), &["it is there and no folder"]);
    assert_says(export::write_maps(&folder.path().join("no/such/maps"), &bare), &["cannot write", "such"]);
    assert_eq!(fs::read_to_string(other.join("height.exr")).expect("is there"), "mine");
}
