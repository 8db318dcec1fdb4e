//! The local PCA of a material on disk.

use std::{path::Path, sync::Arc};

use half::f16;
use overpaint::{
    data::{Lpca, Material, Pair},
    io::material,
};
use zarrs::{
    array::{Array, Element},
    filesystem::FilesystemStore,
};

use super::{
    assert_says,
    material::{bits, entries, saved, walk},
};
use crate::support::material::{local_pca, sample};

crate::suite! { plain:
    a_local_pca_comes_back_bit_by_bit,
    a_local_pca_is_chunked_by_samples,
    a_wrong_local_pca_is_named,
    wrong_numbers_are_named,
    a_local_pca_that_contradicts_itself_is_not_saved;
}

fn a_local_pca_comes_back_bit_by_bit() {
    // A plane and samples of one chunk and of several, and the most clusters and components that there may be.
    for (size, numbers) in [([1, 1], [1, 1, 1]), ([7, 5], [6, 3, 2]), ([300, 257], [13, 255, 7]), ([5, 3], [211, 256, 32])] {
        let material = Material { lpca: Some(local_pca(size, numbers)), ..sample(size, 3) };
        let (_folder, path) = saved(&material);
        let loaded = material::load(&path).expect("loads");
        assert_eq!(bits(&loaded), bits(&material));
        assert_eq!(loaded.lpca, material.lpca);
    }
}

fn a_local_pca_is_chunked_by_samples() {
    let (_folder, path) = saved(&Material { lpca: Some(local_pca([300, 20], [211, 16, 8])), ..sample([300, 20], 3) });
    let read = |name: &str| read_json(&path.join(name));
    let attribute = &read("zarr.json")["attributes"]["lpca"];
    assert_eq!((&attribute["samples"], &attribute["clusters"], &attribute["components"]), (&211.into(), &16.into(), &8.into()));
    assert_eq!(attribute["learned"]["rank"], 61);
    let weights = read("lpca_weights/zarr.json");
    assert_eq!(weights["chunk_grid"]["configuration"]["chunk_shape"], serde_json::json!([20, 256, 8]));
    assert_eq!(weights["dimension_names"], serde_json::json!(["row", "column", "component"]));
    let terms = read("lpca_terms/zarr.json");
    assert_eq!((&terms["data_type"], &terms["fill_value"]), (&"float16".into(), &"NaN".into()));
    assert_eq!(terms["shape"], serde_json::json!([211, 16, 9, 3]));
    assert_eq!(terms["dimension_names"], serde_json::json!(["sample", "cluster", "term", "channel"]));
    assert_eq!(terms["chunk_grid"]["configuration"]["chunk_shape"], serde_json::json!([211, 16, 9, 3]));
    assert_eq!(terms["attributes"]["unit"], "pi L / E");
    // 256 x 33 x 3 halves are 50,688 bytes: 41 samples to 2 MiB.
    let (_folder, path) = saved(&Material { lpca: Some(local_pca([5, 3], [211, 256, 32])), ..sample([5, 3], 3) });
    assert_eq!(walk(&path.join("lpca_terms/c")).len(), 211_usize.div_ceil(41));
    let files = walk(&path).into_iter().filter(|file| file.strip_prefix(&path).is_ok_and(|file| file.to_string_lossy().starts_with("lpca_")));
    let bytes: u64 = files.map(|file| std::fs::metadata(file).expect("is there").len()).sum();
    assert_eq!(material::lpca_bytes(&path).expect("is readable"), bytes);

    let (_folder, path) = saved(&sample([5, 3], 3));
    assert!(read_json(&path.join("zarr.json"))["attributes"]["lpca"].is_null() && !path.join("lpca_terms").exists());
    assert_eq!(material::lpca_bytes(&path).expect("is readable"), 0);
}

fn a_wrong_local_pca_is_named() {
    let (_folder, path) = saved(&Material { lpca: Some(local_pca([4, 4], [6, 3, 2])), ..sample([4, 4], 1) });
    let edits: [(&str, &str, &str, &[&str]); 18] = [
        ("zarr.json", r#""clusters": 3"#, r#""clusters": 0"#, &["\"lpca\" has 0 clusters", "1 to 256"]),
        ("zarr.json", r#""clusters": 3"#, r#""clusters": 257"#, &["has 257 clusters"]),
        ("zarr.json", r#""clusters": 3"#, r#""clusters": -3"#, &["\"lpca\" cannot be read"]),
        ("zarr.json", r#""clusters": 3"#, r#""clusters": 4"#, &["\"lpca_terms\"", "expected shape [6, 4, 3, 3], found [6, 3, 3, 3]"]),
        ("zarr.json", r#""components": 2"#, r#""components": 0"#, &["has 0 components", "1 to 32"]),
        ("zarr.json", r#""components": 2"#, r#""components": 1000000000"#, &["has 1000000000 components"]),
        ("zarr.json", r#""components": 2"#, r#""components": 3"#, &["\"lpca_weights\"", "expected shape [4, 4, 3]"]),
        ("zarr.json", r#""samples": 6,
      "clusters""#, r#""samples": 0,
      "clusters""#, &["has 0 samples"]),
        ("zarr.json", r#""samples": 6,
      "clusters""#, r#""samples": 18446744073709551615,
      "clusters""#, &["has 18446744073709551615 samples"]),
        ("zarr.json", r#""samples": 6,
      "clusters""#, r#""samples": 4294967295,
      "clusters""#, &["\"lpca_pairs\"", "expected shape [4294967295, 2]"]),
        ("zarr.json", r#""relative_rms": 0.30"#, r#""relative_rms": "0.30"#, &["cannot be read"]),
        ("zarr.json", r#""rank": 61"#, r#""rank": null"#, &["\"lpca\" cannot be read"]),
        ("zarr.json", r#""lpca": {"#, r#""lpca": 3, "other": {"#, &["\"lpca\" cannot be read"]),
        ("lpca_terms/zarr.json", r#""float16""#, r#""float32""#, &["\"lpca_terms\"", "data type float16"]),
        ("lpca_terms/zarr.json", r#""float16""#, r#""bfloat16""#, &["\"lpca_terms\""]),
        ("lpca_cluster/zarr.json", "\"chunk_shape\": [\n        4,", "\"chunk_shape\": [\n        2,", &["\"lpca_cluster\"", "chunks of shape [4, 4]"]),
        ("lpca_pairs/zarr.json", "\"shape\": [\n    6,", "\"shape\": [\n    5,", &["\"lpca_pairs\"", "shape [6, 2]"]),
        ("lpca_weights/zarr.json", "{", "", &["\"lpca_weights\""]),
    ];
    for (file, from, to, says) in edits {
        let whole = std::fs::read_to_string(path.join(file)).expect("is there");
        assert!(whole.contains(from), "{file} has no {from}: {whole}");
        std::fs::write(path.join(file), whole.replacen(from, to, 1)).expect("is writable");
        assert_says(material::load(&path), says);
        std::fs::write(path.join(file), whole).expect("is writable");
    }
    // Without a local PCA its arrays are some that nobody asks for.
    let whole = std::fs::read_to_string(path.join("zarr.json")).expect("is there");
    std::fs::write(path.join("zarr.json"), whole.replacen(r#""lpca": {"#, r#""lpca": null, "other": {"#, 1)).expect("is writable");
    assert_eq!(material::load(&path).expect("loads").lpca, None);
    // Shapes and attribute agree on billions of samples, but their chunks are not there.
    std::fs::write(path.join("zarr.json"), whole.replacen("\"samples\": 6,\n      \"clusters", "\"samples\": 4294967295,\n      \"clusters", 1)).expect("is writable");
    for (name, chunk) in [("lpca_pairs", 524_288), ("lpca_terms", 38_836)] {
        let file = path.join(name).join("zarr.json");
        let text = std::fs::read_to_string(&file).expect("is there").replacen("\"shape\": [\n    6,", "\"shape\": [\n    4294967295,", 1);
        let text = text.replacen("\"chunk_shape\": [\n        6,", &format!("\"chunk_shape\": [\n        {chunk},"), 1);
        std::fs::write(file, text).expect("is writable");
    }
    assert_says(material::load(&path), &["\"lpca_pairs\"", "chunk lpca_pairs/c/1/0 is missing"]);
}

/// What a local PCA says of what does not exist is refused on the way in as on the way out.
fn a_local_pca_that_contradicts_itself_is_not_saved() {
    let size = [4, 4];
    let whole = || local_pca(size, [6, 3, 2]);
    let edited = |edit: fn(&mut Lpca)| {
        let mut lpca = whole();
        edit(&mut lpca);
        lpca
    };
    let mut unlearned = whole();
    unlearned.learned.relative_rms = f64::NAN;
    let wrong: [(Lpca, &[&str]); 15] = [
        (unlearned, &["local PCA cannot be read"]),
        (Lpca { clusters: 0, terms: Vec::new(), ..whole() }, &["0 clusters"]),
        (Lpca { clusters: 257, ..whole() }, &["257 clusters"]),
        (Lpca { components: 0, weights: Vec::new(), ..whole() }, &["0 components"]),
        (Lpca { pairs: Vec::new(), terms: Vec::new(), ..whole() }, &["0 samples"]),
        (Lpca { terms: whole().terms[1..].to_vec(), ..whole() }, &["161 values"]),
        (Lpca { weights: whole().weights[2..].to_vec(), ..whole() }, &["30 values"]),
        (local_pca([8, 2], [6, 3, 2]), &["cannot cover 4 x 4"]),
        (local_pca([4, 5], [6, 3, 2]), &["cannot cover 4 x 4"]),
        (edited(|lpca| lpca.cluster[(3, 2)] = 3), &["\"lpca_cluster\"", "below 3, found 3"]),
        (edited(|lpca| lpca.pairs[4].view = 2), &["\"lpca_pairs\"", "below 2 views and 3 lights, found view 2"]),
        (edited(|lpca| lpca.pairs[0].light = usize::MAX), &["\"lpca_pairs\"", "found view 1, light 18446744073709551615"]),
        (edited(|lpca| lpca.terms[50] = f16::NAN), &["\"lpca_terms\"", "that are finite, found NaN"]),
        (edited(|lpca| lpca.terms[50] = f16::INFINITY), &["\"lpca_terms\"", "found inf"]),
        (edited(|lpca| lpca.weights[7] = f16::NEG_INFINITY), &["\"lpca_weights\"", "found -inf"]),
    ];
    for (lpca, says) in wrong {
        let folder = tempfile::tempdir().expect("is writable");
        let material = Material { lpca: Some(lpca), ..sample(size, 1) };
        assert_says(material::save(&folder.path().join("cloth.zarr"), &material), says);
        assert_eq!(entries(folder.path()), 0, "nothing is left of it");
    }
}

fn read_json(path: &Path) -> serde_json::Value {
    serde_json::from_str(&std::fs::read_to_string(path).expect("is there")).expect("is JSON")
}

/// Whole and well-formed, with numbers that nobody saved.
fn wrong_numbers_are_named() {
    let (_folder, path) = saved(&Material { lpca: Some(local_pca([4, 4], [6, 3, 2])), ..sample([4, 4], 1) });
    let whole = material::load(&path).expect("loads");
    let halves = |count: usize, wrong: f16| [vec![f16::ONE; count - 1], vec![wrong]].concat();
    overwrite(&path, "lpca_cluster", &[[0_u8; 15].as_slice(), &[3]].concat());
    assert_says(material::load(&path), &["\"lpca_cluster\"", "expected clusters below 3, found 3"]);
    overwrite(&path, "lpca_cluster", &[2_u8; 16]);
    overwrite(&path, "lpca_pairs", &[0, 0, 1, 2, 0, 1, 1, 3, 0, 0, 0, 0_u32]);
    assert_says(material::load(&path), &["\"lpca_pairs\"", "below 2 views and 3 lights, found view 1, light 3"]);
    overwrite(&path, "lpca_pairs", &[1, 2, 0, 0, u32::MAX, 0, 0, 0, 0, 0, 0, 0_u32]);
    assert_says(material::load(&path), &["found view 4294967295, light 0"]);
    overwrite(&path, "lpca_pairs", &[1_u32; 12]);
    for (wrong, found) in [(f16::NAN, "NaN"), (f16::INFINITY, "inf"), (f16::NEG_INFINITY, "-inf")] {
        for (name, count) in [("lpca_weights", 32), ("lpca_terms", 162)] {
            overwrite(&path, name, &halves(count, wrong));
            assert_says(material::load(&path), &[&format!("\"{name}\""), &format!("expected values that are finite, found {found}")]);
            overwrite(&path, name, &halves(count, f16::MAX));
        }
    }
    let loaded = material::load(&path).expect("is right again").lpca.expect("is there");
    assert_eq!((loaded.pairs[3], loaded.terms[100]), (Pair { view: 1, light: 1 }, f16::ONE));
    assert_eq!(Some(loaded.learned), whole.lpca.map(|lpca| lpca.learned));
}

/// Other values into a stored array.
fn overwrite<N: Element>(path: &Path, name: &str, values: &[N]) {
    let store = Arc::new(FilesystemStore::new(path).expect("is there"));
    let array = Array::open(store, &format!("/{name}")).expect("is there");
    array.store_array_subset(&array.subset_all(), values).expect("is writable");
}
