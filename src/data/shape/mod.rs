//! Built-in meshes, made in double precision from closed forms, the cloth by a relaxation of a fixed number of steps.

mod cloth;
mod torus_knot;

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use super::Mesh;

/// A built-in mesh. y is up; each stands around the origin and reaches about 1 away from it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Shape {
    /// The square from -1 to 1 in x and y, facing +z, with one piece of the material on it.
    Plane,
    /// The sphere of radius 1. Two pieces of the material go around it and one from pole to pole, so that texels are square at the equator.
    Sphere,
    /// A tube of radius 1/7 around the (2, 3) torus knot of radii 4/7 and 2/7, facing +z. Ten pieces of the material lie along it and one
    /// around it, which makes them square to 1.6 % on the average and 35 % on the inner and outer side of the tightest bend.
    TorusKnot,
    /// A square sheet of side 2, with one piece of the material on it, draped over a ball of radius 0.65 around the origin.
    Cloth,
}

impl Shape {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Plane, Self::Sphere, Self::TorusKnot, Self::Cloth];

    /// The name, as files and the command line have it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Plane => "plane",
            Self::Sphere => "sphere",
            Self::TorusKnot => "torus-knot",
            Self::Cloth => "cloth",
        }
    }

    /// The mesh.
    #[must_use]
    pub fn mesh(self) -> Mesh {
        let (vertices, triangles) = match self {
            Self::Plane => plane(),
            Self::Sphere => sphere(),
            Self::TorusKnot => torus_knot::torus_knot(),
            Self::Cloth => cloth::cloth(),
        };
        let single = |vector: DVec3| vector.as_vec3().to_array();
        let mesh = Mesh::new(
            vertices.iter().map(|vertex| single(vertex.position)).collect(),
            vertices.iter().map(|vertex| single(vertex.normal)).collect(),
            vertices.iter().map(|vertex| vertex.tangent.as_vec3().extend(1.0).to_array()).collect(),
            vertices.iter().map(|vertex| vertex.texture.as_vec2().to_array()).collect(),
            triangles,
        );
        mesh.expect("built-in meshes have one of everything for each vertex, in unit frames")
    }
}

/// A vertex of a built-in mesh, of which none is mirrored.
#[derive(Debug, Clone, Copy)]
struct Vertex {
    position: DVec3,
    normal: DVec3,
    tangent: DVec3,
    texture: DVec2,
}

/// Two triangles for each cell of a grid of vertices `[row][column]`, whose columns go right and rows up.
fn grid_triangles(columns: u32, rows: u32) -> Vec<[u32; 3]> {
    let cells = (0..rows - 1).flat_map(|row| (0..columns - 1).map(move |column| row * columns + column));
    cells.flat_map(|at| [[at, at + 1, at + 1 + columns], [at, at + 1 + columns, at + columns]]).collect()
}

fn plane() -> (Vec<Vertex>, Vec<[u32; 3]>) {
    let corner = |x: f64, y: f64| Vertex {
        position: DVec3::new(x, y, 0.0),
        normal: DVec3::Z,
        tangent: DVec3::X,
        texture: (DVec2::new(x, y) + 1.0) / 2.0,
    };
    (vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0)], grid_triangles(2, 2))
}

/// Cells of the sphere around it, and from pole to pole.
const AROUND: u32 = 128;
const ALONG: u32 = 64;

fn sphere() -> (Vec<Vertex>, Vec<[u32; 3]>) {
    // The back is at u = 0, so that the seam is there; the first and the last column are one meridian.
    let vertex = |column: f64, row: u32| {
        let (east, north) = ((column / f64::from(AROUND) % 1.0 - 0.5) * TAU, (f64::from(row) / f64::from(ALONG) - 0.5) * PI);
        // The poles are exact, so that all vertices there are in one place.
        let (height, radius) = if row.is_multiple_of(ALONG) { (north.signum(), 0.0) } else { north.sin_cos() };
        let normal = DVec3::new(radius * east.sin(), height, radius * east.cos());
        Vertex {
            position: normal,
            normal,
            tangent: DVec3::new(east.cos(), 0.0, -east.sin()),
            texture: DVec2::new(2.0 * column / f64::from(AROUND), f64::from(row) / f64::from(ALONG)),
        }
    };
    let columns = AROUND + 1;
    // Between the poles, a grid; at a pole, each triangle has a vertex of its own, in the middle of its longitudes.
    let mut vertices: Vec<_> = (1..ALONG).flat_map(|row| (0..columns).map(move |column| vertex(column.into(), row))).collect();
    let mut triangles = grid_triangles(columns, ALONG - 1);
    let (south, north, last) = ((ALONG - 1) * columns, (ALONG - 1) * columns + AROUND, (ALONG - 2) * columns);
    vertices.extend((0..AROUND).map(|column| vertex(f64::from(column) + 0.5, 0)));
    vertices.extend((0..AROUND).map(|column| vertex(f64::from(column) + 0.5, ALONG)));
    triangles.extend((0..AROUND).map(|column| [column, south + column, column + 1]));
    triangles.extend((0..AROUND).map(|column| [last + column, last + column + 1, north + column]));
    (vertices, triangles)
}
