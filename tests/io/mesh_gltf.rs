use std::path::Path;

use base64::{Engine, engine::general_purpose};
use overpaint::io::{
    self, IoError,
    mesh::{LoadedMesh, MeshFormat},
};
use serde_json::{Value, json};

use super::{assert_says, mesh::exercise_changed};
use crate::{
    law::mesh::{assert_oriented, hold_frames},
    support::random::Random,
};

crate::suite! {
    plain: a_mesh_is_read_from_every_kind_of_buffer, nodes_place_turn_and_mirror, strips_and_fans_become_triangles,
        sparse_arrays_are_read, given_tangents_are_kept, missing_arrays_are_made, faults_say_what_and_where,
        cut_and_changed_files_are_read_or_refused;
}

/// The unit square facing +z, counter-clockwise, as (bytes, document without a URI): positions, normals, texture coordinates with v down,
/// tangents, indices.
fn square() -> (Vec<u8>, Value) {
    let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let texture = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];
    let mut bytes = Vec::new();
    let mut floats = |values: &[f32]| values.iter().for_each(|value| bytes.extend(value.to_le_bytes()));
    floats(positions.as_flattened());
    floats(&[0.0, 0.0, 1.0].repeat(4));
    floats(texture.as_flattened());
    floats(&[0.6, 0.8, 0.0, 1.0].repeat(4));
    [0_u16, 1, 2, 0, 2, 3].iter().for_each(|index| bytes.extend(index.to_le_bytes()));
    let accessor = |view: usize, kind: &str| json!({"bufferView": view, "componentType": 5126, "count": 4, "type": kind});
    let mut positions = accessor(0, "VEC3");
    positions["min"] = json!([0.0, 0.0, 0.0]);
    positions["max"] = json!([1.0, 1.0, 0.0]);
    let document = json!({
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"name": "sheet", "primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 4}]}],
        "accessors": [positions, accessor(1, "VEC3"), accessor(2, "VEC2"), accessor(3, "VEC4"),
            {"bufferView": 4, "componentType": 5123, "count": 6, "type": "SCALAR"}],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 48},
            {"buffer": 0, "byteOffset": 96, "byteLength": 32}, {"buffer": 0, "byteOffset": 128, "byteLength": 64},
            {"buffer": 0, "byteOffset": 192, "byteLength": 12}],
        "buffers": [{"byteLength": bytes.len()}],
    });
    (bytes, document)
}

fn glb(bytes: &[u8], document: &Value) -> Vec<u8> {
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut bytes = bytes.to_vec();
    bytes.resize(bytes.len().next_multiple_of(4), 0);
    let chunk = |kind: &[u8; 4], bytes: &[u8]| [&(bytes.len() as u32).to_le_bytes(), kind, bytes].concat();
    let chunks = [chunk(b"JSON", &text), chunk(b"BIN\0", &bytes)].concat();
    [b"glTF", &2_u32.to_le_bytes()[..], &(12 + chunks.len() as u32).to_le_bytes(), &chunks].concat()
}

fn parsed(bytes: &[u8]) -> Result<LoadedMesh, IoError> {
    Ok(io::mesh::parse("square.glb", bytes, MeshFormat::Gltf, Path::new("/nowhere"))?)
}

/// The square with its document changed.
fn changed(change: impl FnOnce(&mut Value)) -> Result<LoadedMesh, IoError> {
    let (bytes, mut document) = square();
    change(&mut document);
    parsed(&glb(&bytes, &document))
}

fn a_mesh_is_read_from_every_kind_of_buffer() {
    let (bytes, document) = square();
    let expected = parsed(&glb(&bytes, &document)).expect("is a mesh");
    assert_eq!(expected.warnings, [""; 0]);
    let mesh = &expected.mesh;
    assert_eq!(mesh.positions(), [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(mesh.triangles(), [[0, 1, 2], [0, 2, 3]]);
    // v runs up here.
    assert_eq!(mesh.texture_coordinates(), [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    assert!(mesh.tangents().iter().all(|tangent| *tangent == [1.0, 0.0, 0.0, 1.0]));

    let folder = tempfile::tempdir().expect("is writable");
    std::fs::write(folder.path().join("a b.bin"), &bytes).expect("is writable");
    let encoded = general_purpose::STANDARD.encode(&bytes);
    for uri in ["a%20b.bin".to_owned(), format!("data:application/octet-stream;base64,{encoded}")] {
        let mut document = document.clone();
        document["buffers"][0]["uri"] = uri.into();
        let path = folder.path().join("square.gltf");
        std::fs::write(&path, document.to_string()).expect("is writable");
        assert_eq!(io::mesh::load(&path).expect("is a mesh"), expected);
    }
}

fn nodes_place_turn_and_mirror() {
    // A quarter turn about y takes +z to +x; then twice as large and moved. The other child is mirrored in x.
    let nodes = json!([
        {"children": [1, 2], "translation": [10.0, 0.0, 0.0], "scale": [2.0, 2.0, 2.0]},
        {"mesh": 0, "rotation": [0.0, std::f64::consts::FRAC_1_SQRT_2, 0.0, std::f64::consts::FRAC_1_SQRT_2]},
        {"mesh": 0, "matrix": [-1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 5.0, 1.0]},
    ]);
    for tangents in [false, true] {
        let LoadedMesh { mesh, warnings } = changed(|document| {
            document["nodes"] = nodes.clone();
            if tangents {
                document["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] = 3.into();
            }
        })
        .expect("is a mesh");
        assert_eq!(warnings, [""; 0]);
        hold_frames("mesh: frames of placed nodes", &mesh);
        assert_oriented(&mesh);
        let of = |place: [f32; 3]| {
            let vertex = mesh.positions().iter().position(|found| found.map(f32::round) == place).expect("is there");
            (mesh.normals()[vertex].map(f32::round), mesh.tangents()[vertex][3])
        };
        assert_eq!(of([10.0, 0.0, -2.0]), ([1.0, 0.0, 0.0], 1.0));
        assert_eq!(of([8.0, 0.0, 10.0]), ([0.0, 0.0, 1.0], -1.0));
    }
    // Normals keep across a surface that is stretched along one axis: (1, 1)/√2 by (2, 1) is (1, 2)/√5.
    let stretched = changed(|document| {
        document["nodes"] = json!([{"children": [1], "scale": [2.0, 1.0, 1.0]}, {"mesh": 0, "rotation": [0.0, (0.125 * std::f64::consts::PI).sin(), 0.0, (0.125 * std::f64::consts::PI).cos()]}]);
    });
    let normal = stretched.expect("is a mesh").mesh.normals()[0];
    let expected = [1.0 / 5.0_f32.sqrt(), 0.0, 2.0 / 5.0_f32.sqrt()];
    assert!((0..3).all(|axis| (normal[axis] - expected[axis]).abs() < 1e-6), "{normal:?}");
}

fn strips_and_fans_become_triangles() {
    let triangles = |mode: u32, indices: [u16; 4]| {
        let (mut bytes, mut document) = square();
        indices.iter().zip(bytes[192..].chunks_exact_mut(2)).for_each(|(index, bytes)| bytes.copy_from_slice(&index.to_le_bytes()));
        document["accessors"][4]["count"] = 4.into();
        document["meshes"][0]["primitives"][0]["mode"] = mode.into();
        let mesh = parsed(&glb(&bytes, &document)).expect("is a mesh").mesh;
        assert_oriented(&mesh);
        mesh.triangles().iter().map(|triangle| triangle.map(|vertex| mesh.positions()[vertex as usize])).collect::<Vec<_>>()
    };
    let [a, b, c, d] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    assert_eq!(triangles(6, [0, 1, 2, 3]), [[a, b, c], [a, c, d]]);
    assert_eq!(triangles(5, [0, 1, 3, 2]), [[a, b, d], [d, b, c]]);
    assert_eq!(triangles(4, [0, 1, 2, 3]), [[a, b, c]]);
    let points = changed(|document| {
        let primitives = document["meshes"][0]["primitives"].as_array_mut().expect("is one");
        primitives.extend([json!({"mode": 0, "attributes": {"POSITION": 0}}), json!({"mode": 1, "attributes": {"POSITION": 0}})]);
    });
    assert_eq!(points.expect("is a mesh").warnings, ["2 primitives are points or lines and were left out"]);
}

fn sparse_arrays_are_read() {
    let (mut bytes, mut document) = square();
    // Vertex 2 moves to (3, 3, 0).
    bytes.extend([2_u8, 0, 0, 0]);
    [3.0_f32, 3.0, 0.0].iter().for_each(|value| bytes.extend(value.to_le_bytes()));
    document["buffers"][0]["byteLength"] = bytes.len().into();
    let views = document["bufferViews"].as_array_mut().expect("is one");
    views.extend([json!({"buffer": 0, "byteOffset": 204, "byteLength": 1}), json!({"buffer": 0, "byteOffset": 208, "byteLength": 12})]);
    document["accessors"][0]["sparse"] =
        json!({"count": 1, "indices": {"bufferView": 5, "componentType": 5121}, "values": {"bufferView": 6}});
    let mesh = parsed(&glb(&bytes, &document)).expect("is a mesh").mesh;
    assert_eq!(mesh.positions()[2], [3.0, 3.0, 0.0]);
    assert_eq!(mesh.positions()[1], [1.0, 0.0, 0.0]);
    // Without a base all others are 0.
    document["accessors"][0].as_object_mut().expect("is one").remove("bufferView");
    assert_says(parsed(&glb(&bytes, &document)), &["no triangle with an area"]);
    document["accessors"][0]["count"] = 4_000_000_000_u64.into();
    assert_says(parsed(&glb(&bytes, &document)), &["POSITION", "4000000000 of 12 bytes each, not all inside"]);
}

fn given_tangents_are_kept() {
    let loaded = changed(|document| document["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] = 3.into()).expect("is a mesh");
    assert!(loaded.mesh.tangents().iter().all(|tangent| *tangent == [0.6, 0.8, 0.0, 1.0]));
}

fn missing_arrays_are_made() {
    let loaded = changed(|document| {
        document["meshes"][0]["primitives"][0]["attributes"] = json!({"POSITION": 0, "TANGENT": 3});
    });
    let LoadedMesh { mesh, warnings } = loaded.expect("is a mesh");
    assert_eq!(warnings.len(), 2);
    // A tangent without a normal and texture coordinates says nothing.
    assert!(mesh.tangents().iter().all(|tangent| *tangent == [1.0, 0.0, 0.0, 1.0]));
    assert_eq!(mesh.texture_coordinates()[2], [4.0, 4.0]);
    // Without a scene, all nodes count that have no parent.
    let loaded = changed(|document| {
        let document = document.as_object_mut().expect("is one");
        document.remove("scene");
        document.remove("scenes");
    });
    assert_eq!(loaded.expect("is a mesh").mesh.triangles().len(), 2);
}

fn faults_say_what_and_where() {
    type Change = fn(&mut Value);
    let cases: [(Change, &str); 20] = [
        (|d| d["buffers"][0]["uri"] = "gone.bin".into(), "buffer 0: expected a readable file, found /nowhere/gone.bin"),
        (|d| d["buffers"][0]["uri"] = "https://a.b/c".into(), "expected a data URI or a path"),
        (|d| d["buffers"][0]["uri"] = "data:,abc".into(), "expected a data URI in base64"),
        (|d| d["buffers"][0]["byteLength"] = 300.into(), "buffer 0: expected 300 bytes, found 204"),
        (|d| d["buffers"][0]["byteLength"] = u64::MAX.into(), "more than 1073741824 bytes"),
        (|d| d["bufferViews"][0]["byteLength"] = 47.into(), "the POSITION of mesh \"sheet\": expected 1 item or more, all inside"),
        (|d| d["bufferViews"][0]["byteOffset"] = u64::MAX.into(), "the POSITION of mesh"),
        (|d| d["accessors"][1]["byteOffset"] = u64::MAX.into(), "the NORMAL of mesh"),
        (|d| d["accessors"][0]["count"] = u64::MAX.into(), "the POSITION of mesh"),
        (|d| d["accessors"][0]["count"] = 0.into(), "found 0 of 12 bytes each"),
        (|d| d["accessors"][2]["count"] = 3.into(), "the TEXCOORD_0 of mesh \"sheet\": expected one for each of 4 positions, found 3"),
        (|d| d["accessors"][0]["componentType"] = 5123.into(), "expected Vec3 of [F32], found Vec3 of U16"),
        (|d| d["accessors"][4]["type"] = "VEC2".into(), "the indices of mesh \"sheet\": expected Scalar"),
        (|d| d["accessors"][4]["byteOffset"] = 2.into(), "the indices of mesh"),
        (|d| d["bufferViews"][4]["byteOffset"] = 12.into(), "triangle 0 names vertex 16256, but the 4 vertices"),
        (|d| d["meshes"][0]["primitives"][0]["attributes"] = json!({"NORMAL": 1}), "Missing data"),
        (|d| d["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 9.into(), "a mesh names accessor 9, but there are 5"),
        (|d| d["nodes"][0]["mesh"] = 7.into(), "Index out of bounds"),
        (|d| d["nodes"][0]["children"] = json!([0]), "node 0 is reached in two ways"),
        (|d| d["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]), "it needs the extension KHR_draco_mesh_compression"),
    ];
    for (change, part) in cases {
        assert_says(changed(change), &["square.glb: ", part]);
    }
    // Extensions of materials do not matter.
    let unlit = changed(|document| document["extensionsRequired"] = json!(["KHR_materials_unlit"]));
    assert_eq!(unlit.expect("is a mesh").warnings, [""; 0]);
    let (mut bytes, document) = square();
    bytes[4..8].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_says(parsed(&glb(&bytes, &document)), &["the position of vertex 0 has the component NaN"]);
    let (mut bytes, document) = square();
    bytes[48..52].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_says(parsed(&glb(&bytes, &document)), &["the normal of vertex 0 has the component NaN"]);
    assert_says(parsed(b"glTF\x02\0\0\0\x05\0\0\0"), &["the header of a .glb is cut off"]);
    assert_says(parsed(b"glTF\x01\0\0\0\x0c\0\0\0"), &["unsupported version"]);
    assert_says(parsed(b"solid"), &["cannot be read"]);
}

fn cut_and_changed_files_are_read_or_refused() {
    let (bytes, mut document) = square();
    document["accessors"][0]["sparse"] =
        json!({"count": 1, "indices": {"bufferView": 4, "componentType": 5123}, "values": {"bufferView": 1}});
    let binary = glb(&bytes, &document);
    exercise_changed(&binary, MeshFormat::Gltf, b"0123456789-.,:[]{}\"\0\xff\x7f", 2000);
    // Numbers of the document that are others, which keep it a document.
    let text = document.to_string();
    for seed in 0..2000 {
        let mut random = Random::new(seed);
        let mut changed = text.clone().into_bytes();
        for _ in 0..1 + random.below(3) {
            let digits: Vec<_> = (0..changed.len()).filter(|&at| changed[at].is_ascii_digit()).collect();
            changed[digits[random.below(digits.len())]] = b'0' + random.below(10) as u8;
        }
        let document: Value = match serde_json::from_slice(&changed) {
            Ok(document) => document,
            Err(_) => continue,
        };
        super::mesh::exercise(&glb(&bytes, &document), MeshFormat::Gltf);
    }
}
