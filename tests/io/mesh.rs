use std::path::Path;

use glam::{DVec2, DVec3};
use overpaint::{
    data::{Mesh, mesh::doubled_area},
    io::{
        self, IoError,
        mesh::{LoadedMesh, MeshFormat},
    },
};

use super::assert_says;
use crate::{
    law::mesh::{assert_oriented, hold_frames},
    support::{hold, random::Random},
};

crate::suite! {
    plain: a_bare_cube_gets_normals_and_a_box, whatever_an_obj_holds_is_read, parts_that_have_less_are_completed,
        clockwise_and_thin_triangles_are_mended, faults_say_what_and_where, cut_and_changed_objs_are_read_or_refused;
    data: boxes_cover_a_model_without_texture_coordinates;
}

/// The corners of a cube from 0 to 2 and its sides, counter-clockwise from outside.
const CUBE: &str = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 0 2\nv 2 0 2\nv 2 2 2\nv 0 2 2\n\
    f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 4 1 5 8\n";

fn obj(text: &str) -> Result<LoadedMesh, IoError> {
    Ok(io::mesh::parse("cube.obj", text.as_bytes(), MeshFormat::Obj, Path::new(""))?)
}

fn read(text: &str) -> LoadedMesh {
    obj(text).expect("is a mesh")
}

fn a_bare_cube_gets_normals_and_a_box() {
    let LoadedMesh { mesh, warnings } = read(CUBE);
    assert_eq!((mesh.triangles().len(), mesh.positions().len()), (12, 24));
    assert_eq!(warnings.len(), 2, "{warnings:?}");
    assert!(warnings[0].contains("8 of 8 vertices have no normals") && warnings[1].contains("12 of 12 triangles have no texture"));
    hold_frames("mesh: frames of a cube", &mesh);
    assert_oriented(&mesh);
    for (normal, position) in mesh.normals().iter().zip(mesh.positions()) {
        // Angles, unlike areas, do not depend on the diagonals.
        let out = (DVec3::from_array(position.map(f64::from)) - 1.0).normalize();
        hold("mesh: smooth normals of a cube", (DVec3::from_array(normal.map(f64::from)) - out).length(), 2e-7);
    }
    assert_boxed(&mesh, 2.0);
    // Each side has four by four pieces.
    let range = |axis: usize| mesh.texture_coordinates().iter().map(move |place| place[axis]);
    assert_eq!(range(0).fold(0.0, f32::max) - range(0).fold(0.0, f32::min), 8.0);
    assert_eq!(range(1).fold(0.0, f32::max) - range(1).fold(0.0, f32::min), 8.0);
}

/// Each triangle lies upright on a side of the box, as large there as it is from that side, and no smaller than by the box's diagonal.
fn assert_boxed(mesh: &Mesh, largest: f64) {
    for &triangle in mesh.triangles() {
        let [a, b, c] = triangle.map(|vertex| DVec2::from_array(mesh.texture_coordinates()[vertex as usize].map(f64::from)));
        let pieces = (b - a).perp_dot(c - a) * (largest / 4.0).powi(2);
        let out = doubled_area(mesh.positions(), triangle);
        // Texture coordinates of magnitude 4 are rounded by 2e-7 times the length of an edge in pieces.
        let rounding = 1e-6 * (largest / 4.0) * ((b - a).length() + (c - a).length());
        assert!((pieces - out.abs().max_element()).abs() <= rounding, "{pieces} of {out}");
        assert!(pieces >= out.length() / 3.0_f64.sqrt() - rounding);
    }
}

fn boxes_cover_a_model_without_texture_coordinates(data: &Path) {
    let text = std::fs::read_to_string(data.join("spot.obj")).expect("is readable");
    let bare = text.lines().map(|line| match line.split_once(' ') {
        Some(("f", corners)) => {
            let places = corners.split(' ').map(|corner| corner.split('/').next().unwrap_or_default());
            format!("f {}\n", places.collect::<Vec<_>>().join(" "))
        }
        _ => format!("{line}\n"),
    });
    let LoadedMesh { mesh, warnings } = read(&bare.collect::<String>());
    assert_eq!((mesh.triangles().len(), warnings.len()), (5856, 2));
    hold_frames("mesh: frames of spot.obj in a box", &mesh);
    let [low, high] = mesh.bounds();
    let largest = (0..3).map(|axis| f64::from(high[axis]) - f64::from(low[axis])).fold(0.0, f64::max);
    assert_boxed(&mesh, largest);
    // A vertex is there once for each side that it is on, one in three of them on two.
    println!("spot.obj in a box: {} vertices", mesh.positions().len());
    assert!((2930..2 * 2930).contains(&mesh.positions().len()));
}

fn whatever_an_obj_holds_is_read() {
    let text = "# \u{e9}\r\nmtllib none.mtl\r\no first\r\nv 0 0 0 1 0 0\r\nv 1 0 0\r\nv 1 1 0 1.0\r\nv 0 1 0\r\nv 0.5 2 0\r\n\
        vt 0 0 7\r\nvt 1 0\r\nvt 1 1\r\nvt 0 1\r\nvt 0.5 2\r\nvn 0 0 2\r\ng any\r\nusemtl x\r\ns 1\r\nl 1 2 3\r\np 1\r\n\
        f -5/-5/-1 -4/-4/-1 \\\r\n  3/3/1 5/5/1 4/4/1\r\n";
    let LoadedMesh { mesh, warnings } = read(text);
    assert_eq!(warnings, [""; 0]);
    assert_eq!((mesh.positions().len(), mesh.triangles()), (5, &[[0, 1, 2], [0, 2, 3], [0, 3, 4]][..]));
    assert_eq!(mesh.texture_coordinates(), [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.5, 2.0], [0.0, 1.0]]);
    assert_eq!((mesh.normals()[4], mesh.tangents()[4]), ([0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0]));
    // Bytes that are no text stand in comments and names only.
    let bytes = [b"# \xff\xfe\n", text.as_bytes()].concat();
    let again = io::mesh::parse("a.obj", &bytes, MeshFormat::Obj, Path::new("")).expect("is a mesh");
    assert_eq!(again.mesh, mesh);
}

fn parts_that_have_less_are_completed() {
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\nf 1/1/1 2/2/1 3/3/1\nf 1 3 4\nf 1//1 2//1 4//1\n";
    let LoadedMesh { mesh, warnings } = read(text);
    assert_eq!(mesh.triangles().len(), 3);
    assert_eq!(warnings.len(), 2, "{warnings:?}");
    assert!(warnings[0].starts_with("3 of 9 vertices have no normals") && warnings[1].starts_with("2 of 3 triangles have no texture"));
    assert!(mesh.normals().iter().all(|normal| *normal == [0.0, 0.0, 1.0]));
    assert_eq!(mesh.texture_coordinates()[2], [1.0, 1.0]);
    // Boxes have four pieces over the extent of 1.
    assert_eq!(mesh.texture_coordinates()[4], [4.0, 4.0]);
}

fn clockwise_and_thin_triangles_are_mended() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.5 0.5 0\nvt 0 0\nvn 0 0 1\nvn 0 0 0\nf 1/1/1 3/1/1 2/1/1\nf 2/1/2 3/1/2 4/1/2\nf 1/1/2 2/1/2 2/1/2\nf 1/1/2 2/1/2 3/1/2\n";
    let LoadedMesh { mesh, warnings } = read(text);
    assert_eq!(warnings.len(), 4, "{warnings:?}");
    assert!(warnings[0].starts_with("2 of 4 triangles have no area"));
    assert!(warnings[1].starts_with("1 of 2 triangles ran clockwise"));
    assert!(warnings[2].starts_with("3 of 7 vertices have no normals"));
    assert!(warnings[3].starts_with("2 of 2 triangles have no area in texture coordinates"));
    hold_frames("mesh: frames of mended triangles", &mesh);
    for &triangle in mesh.triangles() {
        assert!(doubled_area(mesh.positions(), triangle).z > 0.0);
    }
}

fn faults_say_what_and_where() {
    let cases = [
        ("v 0 0 0\nv 1 0\n", "cube.obj: line 2: expected three finite numbers after v, found \"v 1 0\""),
        ("v 0 0 nan\n", "line 1: expected three finite numbers"),
        ("v 0 0 1e39\n", "line 1: expected three finite numbers"),
        ("vt 0\n", "line 1: expected two finite numbers after vt"),
        ("vn 0 0 x\n", "line 1: expected three finite numbers after vn"),
        ("f 1 2\n", "line 1: expected three or more corners after f"),
        ("v 0 0 0\nf 1 1 0\n", "line 2: expected three or more corners"),
        ("v 0 0 0\nf 1/1/1/1 1 1\n", "line 2: expected three or more corners"),
        ("v 0 0 0\nf 99999999999999999999 1 1\n", "line 2: expected three or more corners"),
        ("v 0 0 0\nvt 0 0\nf 1/1 1 1\n", "line 3: expected corners that all have the same"),
        ("v 0 0 0\nf 1 1 \\\n 2\n", "line 2: a face names vertex 2, but 1 are numbered from 1 up to this line and 1 in all"),
        ("v 0 0 0\nf -2 1 1\n", "line 2: a face names vertex -2"),
        ("v 0 0 0\nf -9223372036854775808 1 1\n", "line 2: a face names vertex -9223372036854775808"),
        ("v 0 0 0\nf 1/1 1/1 1/1\n", "line 2: a face names texture coordinate 1, but 0"),
        ("v 0 0 0\nvn 0 0 1\nf 1//-2 1//1 1//1\n", "line 3: a face names normal -2"),
        ("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "no triangle with an area"),
        ("v 0 0 0\nv 1e13 0 0\nv 0 1 0\nf 1 2 3\n", "the position of vertex 1 has the component 10000000000000"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 1e7 0\nf 1/1 2/1 3/1\n", "the texture coordinate of vertex 0 has the component 10000000"),
        ("v 0 0 0\n", "no triangle with an area"),
        ("", "no triangle with an area"),
    ];
    for (text, part) in cases {
        assert_says(obj(text), &["cube.obj", part]);
    }
    let folder = tempfile::tempdir().expect("is writable");
    let path = folder.path().join("a.obj");
    assert!(matches!(io::mesh::load(&path), Err(IoError::NotFound { .. })));
    std::fs::create_dir(&path).expect("is writable");
    assert!(matches!(io::mesh::load(&path), Err(IoError::Read { .. })));
    assert_says(io::mesh::load(&folder.path().join("a.ply")), &["a.ply", "must end in .obj, .gltf or .glb, found .ply"]);
    assert_says(io::mesh::load(folder.path()), &["must end in .obj, .gltf or .glb, found"]);
    std::fs::write(folder.path().join("B.OBJ"), CUBE).expect("is writable");
    assert_eq!(io::mesh::load(&folder.path().join("B.OBJ")).expect("is a mesh"), read(CUBE));
}

/// Reads bytes, which must give frames or an error that names the file.
pub fn exercise(bytes: &[u8], format: MeshFormat) {
    match io::mesh::parse("any.mesh", bytes, format, Path::new("/nowhere")) {
        Ok(loaded) => hold_frames("mesh: frames of changed files", &loaded.mesh),
        Err(error) => assert!(error.to_string().starts_with("any.mesh: "), "{error}"),
    }
}

/// The bytes cut everywhere, and with a few of them changed.
pub fn exercise_changed(bytes: &[u8], format: MeshFormat, changes: &[u8], rounds: u64) {
    for end in 0..bytes.len() {
        exercise(&bytes[..end], format);
    }
    for seed in 0..rounds {
        let mut random = Random::new(seed);
        let mut changed = bytes.to_vec();
        for _ in 0..1 + random.below(4) {
            let (at, byte) = (random.below(changed.len()), changes[random.below(changes.len())]);
            match random.below(3) {
                0 => changed[at] = byte,
                1 => changed.insert(at, byte),
                _ => drop(changed.remove(at)),
            }
        }
        exercise(&changed, format);
    }
}

fn cut_and_changed_objs_are_read_or_refused() {
    let text = format!("vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\n{CUBE}f 1/1/1 2/2/1 -6/3/1 \\\n 4/1/1\nl 1 2\nf 1//1 2//1 3//1\n");
    exercise_changed(text.as_bytes(), MeshFormat::Obj, b"0123456789-./ \n\\vtnfe#\xff", 3000);
}
