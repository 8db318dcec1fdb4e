//! Materials on disk.

use std::path::{Path, PathBuf};

use overpaint::{
    data::Material,
    io::{self, Kind, material},
};
use tempfile::TempDir;

use super::assert_says;
use crate::support::material::{local_pca, sample};

crate::suite! { plain:
    a_round_trip_keeps_every_bit,
    the_group_follows_the_zarr_specification,
    another_material_is_replaced,
    nothing_else_is_replaced,
    a_half_written_folder_is_no_material,
    missing_and_damaged_arrays_are_named,
    wrong_metadata_are_named,
    a_further_array_is_left_alone;
}

/// Everything as bits, so that NaN equals itself.
pub(super) fn bits(material: &Material) -> Vec<u32> {
    let Material { height, normal, normal_measured, albedo, svbrdf, fit, lpca, .. } = material;
    let floats = [
        height.values(),
        normal.values().as_flattened(),
        normal_measured.values().as_flattened(),
        albedo.values(),
        svbrdf.diffuse.values().as_flattened(),
        fit.objective_without_lobe.values(),
        fit.objective.values(),
    ];
    floats
        .concat()
        .into_iter()
        .chain(svbrdf.lobes.iter().flat_map(|lobe| [lobe.specular.values().as_flattened(), lobe.parameters.values().as_flattened()].concat()))
        .map(f32::to_bits)
        .chain([fit.iterations.values(), fit.status.values(), fit.masked.values()].concat())
        .chain(lpca.iter().flat_map(|lpca| lpca.weights.iter().chain(&lpca.terms).map(|half| u32::from(half.to_bits()))))
        .chain(lpca.iter().flat_map(|lpca| lpca.error.values().iter().map(|error| error.to_bits()).chain(lpca.cluster.values().to_vec())))
        .chain(lpca.iter().flat_map(|lpca| lpca.pairs.iter().flat_map(|pair| [pair.view as u32, pair.light as u32])))
        .collect()
}

pub(super) fn saved(material: &Material) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("is writable");
    let path = folder.path().join("cloth.zarr");
    material::save(&path, material).expect("saves");
    (folder, path)
}

pub(super) fn entries(folder: &Path) -> usize {
    std::fs::read_dir(folder).expect("is readable").count()
}

fn a_round_trip_keeps_every_bit() {
    // Within one chunk, exactly one, and over its edge in both directions.
    for size in [[1, 1], [7, 5], [256, 256], [300, 257]] {
        let material = sample(size, 3);
        let (folder, path) = saved(&material);
        let loaded = material::load(&path).expect("loads");
        assert_eq!((loaded.size(), bits(&loaded)), (size, bits(&material)));
        assert_eq!(loaded.provenance, material.provenance);
        assert_eq!((io::kind(&path), entries(folder.path())), (Kind::Material, 1));
    }
}

fn the_group_follows_the_zarr_specification() {
    let (_folder, path) = saved(&sample([300, 20], 3));
    let read = |name: &str| -> serde_json::Value {
        serde_json::from_str(&std::fs::read_to_string(path.join(name)).expect("is there")).expect("is JSON")
    };
    let group = read("zarr.json");
    assert_eq!((&group["zarr_format"], &group["node_type"]), (&3.into(), &"group".into()));
    assert_eq!(group["attributes"]["format"], material::MATERIAL_FORMAT);
    assert_eq!(group["attributes"]["conventions"]["rows"], "row 0 is the top row, column 0 the left column");
    assert_eq!(group["attributes"]["provenance"]["settings"]["boundary"], "periodic");
    assert_eq!(group["attributes"]["provenance"]["views"], serde_json::json!([[0.0, 0.0], [23.5, 359.999_999]]), "degrees");
    let lobe = read("lobe/zarr.json");
    assert_eq!(lobe["shape"], serde_json::json!([20, 300, 4]));
    assert_eq!(lobe["chunk_grid"]["configuration"]["chunk_shape"], serde_json::json!([20, 256, 4]));
    assert_eq!(lobe["dimension_names"], serde_json::json!(["row", "column", "parameter"]));
    assert_eq!((&lobe["data_type"], &lobe["fill_value"]), (&"float32".into(), &"NaN".into()));
    assert_eq!(read("fit_status/zarr.json")["data_type"], "uint8");
    assert_eq!(read("height/zarr.json")["attributes"]["unit"], "texel widths");
    assert!(path.join("specular/c/0/1/0").is_file(), "a chunk of one value is stored");
}

fn another_material_is_replaced() {
    let (folder, path) = saved(&sample([7, 5], 1));
    let other = sample([3, 300], 2);
    material::save(&path, &other).expect("replaces");
    assert_eq!(bits(&material::load(&path).expect("loads")), bits(&other));
    assert_eq!(entries(folder.path()), 1);
}

fn nothing_else_is_replaced() {
    let folder = tempfile::tempdir().expect("is writable");
    let path = folder.path().join("mine");
    std::fs::write(&path, "a file").expect("is writable");
    let material = sample([2, 2], 1);
    assert_says(material::save(&path, &material), &["mine is left as it is", "no overpaint material"]);
    assert_eq!(std::fs::read_to_string(&path).expect("is there"), "a file");
    std::fs::remove_file(&path).expect("was there");
    std::fs::create_dir(&path).expect("is writable");
    assert_says(material::save(&path, &material), &["holds no zarr.json"]);
    std::fs::write(path.join("zarr.json"), r#"{"zarr_format": 3, "node_type": "group", "attributes": {"format": "other"}}"#)
        .expect("is writable");
    assert_says(material::save(&path, &material), &["\"format\" is \"other\""]);
    assert_eq!(entries(&path), 1);

    for note in ["notes.txt", "height/notes.txt", "more/notes.txt"] {
        let (_folder, path) = saved(&material);
        std::fs::create_dir_all(path.join(note).parent().expect("has one")).expect("is writable");
        std::fs::write(path.join(note), "mine").expect("is writable");
        assert_says(material::save(&path, &material), &["also holds", note.split('/').next().expect("is there")]);
        assert_says(material::check_target(&path), &["also holds"]);
        assert_eq!(std::fs::read_to_string(path.join(note)).expect("is there"), "mine");
    }
    #[cfg(unix)]
    {
        let (folder, path) = saved(&material);
        let link = folder.path().join("link");
        std::os::unix::fs::symlink(&path, &link).expect("is writable");
        assert_says(material::save(&link, &material), &["it is a link"]);
        assert_says(material::check_target(&link), &["it is a link"]);
        material::check_target(&path).expect("a material may be replaced");
    }
    assert_says(material::save(&folder.path().join("no/such/folder"), &material), &["cannot write"]);
}

/// Whatever a killed save leaves: the group's metadata come last.
fn a_half_written_folder_is_no_material() {
    let (folder, path) = saved(&sample([4, 4], 1));
    std::fs::remove_file(path.join("zarr.json")).expect("was there");
    assert_says(material::load(&path), &["cloth.zarr is no overpaint material", "holds no zarr.json", "overpaint fit"]);
    assert_eq!(io::kind(&path), Kind::Neither);
    for text in ["", "{", "[]", r#"{"zarr_format": 3, "node_type": "array", "attributes": {}}"#, r#"{"zarr_format": 2}"#] {
        std::fs::write(path.join("zarr.json"), text).expect("is writable");
        assert_says(material::load(&path), &["cloth.zarr is no overpaint material"]);
    }
    assert_says(material::load(&folder.path().join("absent")), &["absent does not exist"]);
}

fn missing_and_damaged_arrays_are_named() {
    let names = [
        "height",
        "normal",
        "normal_measured",
        "albedo",
        "diffuse",
        "specular",
        "lobe",
        "fit_objective_without_lobe",
        "fit_objective",
        "fit_iterations",
        "fit_status",
        "fit_masked",
        "lpca_cluster",
        "lpca_weights",
        "lpca_terms",
        "lpca_error",
        "lpca_pairs",
    ];
    let material = Material { lpca: Some(local_pca([9, 300], [6, 3, 2])), ..sample([9, 300], 1) };
    let (_folder, path) = saved(&material);
    for name in names {
        let array = path.join(name);
        let chunk = walk(&array.join("c")).pop().expect("has chunks");
        let whole = std::fs::read(&chunk).expect("is there");
        let mut flipped = whole.clone();
        flipped[whole.len() / 2] ^= 0x10;
        for damaged in [&whole[..whole.len() / 2], &whole[..whole.len() - 1], &[], &flipped] {
            std::fs::write(&chunk, damaged).expect("is writable");
            match material::load(&path) {
                // gzip has bits that mean nothing.
                Ok(loaded) if damaged.len() == whole.len() => assert_eq!(bits(&loaded), bits(&material)),
                result => assert_says(result, &[&format!("array \"{name}\""), "cloth.zarr", "fit the material again"]),
            }
        }
        std::fs::remove_file(&chunk).expect("was there");
        assert_says(material::load(&path), &[&format!("array \"{name}\""), "chunk", "is missing"]);
        std::fs::write(&chunk, &whole).expect("is writable");

        let metadata = std::fs::read(array.join("zarr.json")).expect("is there");
        std::fs::remove_file(array.join("zarr.json")).expect("was there");
        assert_says(material::load(&path), &[&format!("array \"{name}\"")]);
        std::fs::write(array.join("zarr.json"), metadata).expect("is writable");
    }
    material::load(&path).expect("is whole again");
}

pub(super) fn walk(folder: &Path) -> Vec<PathBuf> {
    let paths = std::fs::read_dir(folder).expect("is readable").map(|entry| entry.expect("is readable").path());
    paths.flat_map(|path| if path.is_dir() { walk(&path) } else { vec![path] }).collect()
}

fn wrong_metadata_are_named() {
    let (_folder, path) = saved(&sample([4, 4], 1));
    let edits: [(&str, &str, &str, &[&str]); 9] = [
        ("zarr.json", r#""format_version": 4"#, r#""format_version": 2"#, &["version 2", "version 4"]),
        ("zarr.json", r#""width": 4"#, r#""width": 4000000000000"#, &["expected shape [4, 4000000000000", "found [4, 4"]),
        ("zarr.json", r#""width": 4"#, r#""width": -4"#, &["\"width\" is -4"]),
        ("zarr.json", r#""boundary": "periodic""#, r#""boundary": "fractal""#, &["provenance", "fractal"]),
        ("height/zarr.json", r#""float32""#, r#""float64""#, &["\"height\"", "data type float32", "float64"]),
        ("albedo/zarr.json", "\"shape\": [\n    4,", "\"shape\": [\n    5,", &["\"albedo\"", "shape [4, 4]", "found [5, 4]"]),
        (
            "lobe/zarr.json",
            "\"chunk_shape\": [\n        4,",
            "\"chunk_shape\": [\n        4000000000,",
            &["\"lobe\"", "chunks of shape [4, 4, 4]"],
        ),
        ("lobe/zarr.json", r#""gzip""#, r#""unheard of""#, &["\"lobe\""]),
        ("normal/zarr.json", "{", "", &["\"normal\""]),
    ];
    for (file, from, to, says) in edits {
        let whole = std::fs::read_to_string(path.join(file)).expect("is there");
        assert!(whole.contains(from), "{file} has no {from}: {whole}");
        std::fs::write(path.join(file), whole.replacen(from, to, 1)).expect("is writable");
        assert_says(material::load(&path), says);
        std::fs::write(path.join(file), whole).expect("is writable");
    }
    // All shapes agree on an absurd plane, but its chunks are not there.
    for file in walk(&path).into_iter().filter(|file| file.ends_with("zarr.json")) {
        let text = std::fs::read_to_string(&file).expect("is there");
        let text = text.replace("\"width\": 4", "\"width\": 1099511627776").replace("\"height\": 4", "\"height\": 1099511627776");
        let text = text.replacen("\"shape\": [\n    4,\n    4", "\"shape\": [\n    1099511627776,\n    1099511627776", 1);
        let text = text.replacen("\"chunk_shape\": [\n        4,\n        4", "\"chunk_shape\": [\n        256,\n        256", 1);
        std::fs::write(file, text).expect("is writable");
    }
    assert_says(material::load(&path), &["chunk", "is missing"]);
}

fn a_further_array_is_left_alone() {
    let material = sample([4, 4], 1);
    let (_folder, path) = saved(&material);
    std::fs::create_dir(path.join("weights")).expect("is writable");
    std::fs::write(path.join("weights/zarr.json"), "{}").expect("is writable");
    assert_eq!(bits(&material::load(&path).expect("loads")), bits(&material));
}
