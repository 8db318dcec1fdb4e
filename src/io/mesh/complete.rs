//! Parts of a file, joined and completed to a mesh.

use std::collections::HashMap;

use glam::DVec3;

use super::MeshFault;
use crate::data::{
    Mesh, MeshError, across,
    mesh::{MAX_POSITION, MAX_VERTICES, bounds, doubled_area, has_numbers, places},
};

/// Pieces of the material over the largest extent of a mesh without texture coordinates.
const PIECES: f64 = 4.0;

/// A triangle is no surface if it is thinner than this part of its length.
const THIN: f64 = 1e-12;

/// A part of a mesh as its file has it; v runs up.
pub(super) struct Part {
    pub positions: Vec<[f32; 3]>,
    pub normals: Option<Vec<[f32; 3]>>,
    pub texture_coordinates: Option<Vec<[f32; 2]>>,
    pub tangents: Option<Vec<[f32; 4]>>,
    pub triangles: Vec<[u32; 3]>,
}

/// All parts, one after the other.
#[derive(Default)]
struct Joined {
    positions: Vec<[f32; 3]>,
    normals: Vec<Option<[f32; 3]>>,
    texture_coordinates: Vec<Option<[f32; 2]>>,
    tangents: Vec<Option<[f32; 4]>>,
    triangles: Vec<[u32; 3]>,
}

/// The mesh of all parts, with a sentence for what was made or left out.
pub(super) fn mesh(parts: Vec<Part>, warnings: &mut Vec<String>) -> Result<Mesh, MeshFault> {
    let mut joined = Joined::new(parts)?;
    joined.drop_thin(warnings)?;
    joined.turn(warnings);
    let normals = joined.complete_normals(warnings);
    joined.finish(&normals, warnings)
}

impl Joined {
    fn new(parts: Vec<Part>) -> Result<Self, MeshFault> {
        let mut joined = Self::default();
        for part in parts {
            let (start, vertices) = (joined.positions.len(), part.positions.len());
            for (what, found) in [("vertices", start + vertices), ("triangles", joined.triangles.len() + part.triangles.len())] {
                if found > MAX_VERTICES {
                    return Err(MeshFault::TooMany { what, found, most: MAX_VERTICES });
                }
            }
            for (triangle, corners) in part.triangles.iter().enumerate() {
                if let Some(&index) = corners.iter().find(|&&index| index as usize >= vertices) {
                    return Err(MeshError::Index { triangle, index, vertices }.into());
                }
                #[expect(clippy::cast_possible_truncation, reason = "both are at most 2^24")]
                joined.triangles.push(corners.map(|index| start as u32 + index));
            }
            has_numbers("position", &part.positions, MAX_POSITION)?;
            has_numbers("normal", part.normals.as_deref().unwrap_or_default(), f32::MAX)?;
            has_numbers("tangent", part.tangents.as_deref().unwrap_or_default(), f32::MAX)?;
            // What a tangent is good for needs the others.
            let tangents = part.tangents.filter(|_| part.normals.is_some() && part.texture_coordinates.is_some());
            joined.positions.extend(part.positions);
            joined.normals.extend(each(part.normals, vertices).map(|normal| normal.filter(|normal| *normal != [0.0; 3])));
            joined.texture_coordinates.extend(each(part.texture_coordinates, vertices));
            joined.tangents.extend(each(tangents, vertices).map(|tangent| tangent.filter(|tangent| tangent[..3] != [0.0; 3])));
        }
        Ok(joined)
    }

    /// The corners of a triangle.
    fn corners(&self, triangle: [u32; 3]) -> [DVec3; 3] {
        triangle.map(|vertex| DVec3::from_array(self.positions[vertex as usize].map(f64::from)))
    }

    /// Leaves out triangles without an area.
    fn drop_thin(&mut self, warnings: &mut Vec<String>) -> Result<(), MeshFault> {
        let all = self.triangles.len();
        let triangles = std::mem::take(&mut self.triangles);
        let is_surface = |triangle: &[u32; 3]| {
            let [a, b, c] = self.corners(*triangle);
            let longest = [b - a, c - b, a - c].map(DVec3::length_squared).into_iter().fold(0.0, f64::max);
            doubled_area(&self.positions, *triangle).length() > THIN * longest
        };
        self.triangles = triangles.into_iter().filter(is_surface).collect();
        let dropped = all - self.triangles.len();
        if self.triangles.is_empty() {
            return Err(MeshFault::Empty);
        }
        if dropped > 0 {
            warnings.push(format!("{dropped} of {all} triangles have no area and were left out"));
        }
        Ok(())
    }

    /// Turns triangles that run clockwise, seen from where their normals point.
    fn turn(&mut self, warnings: &mut Vec<String>) {
        let mut turned = 0;
        for triangle in &mut self.triangles {
            let out = doubled_area(&self.positions, *triangle);
            let toward = |vertex: u32| self.normals[vertex as usize].map_or(0.0, |normal| out.dot(vector(normal).normalize_or_zero()));
            if triangle.iter().map(|&vertex| toward(vertex)).sum::<f64>() < 0.0 {
                triangle.swap(1, 2);
                turned += 1;
            }
        }
        if turned > 0 {
            warnings.push(format!("{turned} of {} triangles ran clockwise around their normals and were turned", self.triangles.len()));
        }
    }

    /// Unit normals: those of the file, smooth ones where there are none.
    fn complete_normals(&self, warnings: &mut Vec<String>) -> Vec<DVec3> {
        let mut normals: Vec<Option<DVec3>> = self.normals.iter().map(|normal| normal.map(|normal| vector(normal).normalize())).collect();
        let mut corners: Vec<_> = self.triangles.iter().flatten().map(|&vertex| vertex as usize).collect();
        corners.retain(|&vertex| self.normals[vertex].is_none());
        if !corners.is_empty() {
            let (places, count) = places(&self.positions);
            let mut sums = vec![DVec3::ZERO; count as usize];
            for &triangle in &self.triangles {
                let out = doubled_area(&self.positions, triangle).normalize();
                let positions = self.corners(triangle);
                for (corner, vertex) in triangle.into_iter().enumerate().filter(|(_, vertex)| self.normals[*vertex as usize].is_none()) {
                    let [before, after] = [2, 1].map(|step| positions[(corner + step) % 3] - positions[corner]);
                    sums[places[vertex as usize] as usize] += before.angle_between(after) * out;
                }
            }
            for &triangle in &self.triangles {
                for vertex in triangle.map(|vertex| vertex as usize) {
                    // Where faces cancel out, as on the rim of a sheet with two sides, each has its own.
                    let sum = sums[places[vertex] as usize];
                    let smooth = || if sum.length() > 1e-6 { sum.normalize() } else { doubled_area(&self.positions, triangle).normalize() };
                    normals[vertex].get_or_insert_with(smooth);
                }
            }
            corners.sort_unstable();
            corners.dedup();
            warnings.push(format!("{} of {} vertices have no normals: smooth ones were made", corners.len(), self.positions.len()));
        }
        normals.into_iter().map(Option::unwrap_or_default).collect()
    }

    /// The mesh of the vertices that triangles have, with texture coordinates and tangents.
    fn finish(self, normals: &[DVec3], warnings: &mut Vec<String>) -> Result<Mesh, MeshFault> {
        let used: Vec<_> = self.triangles.iter().flatten().map(|&vertex| self.positions[vertex as usize]).collect();
        let projection = Projection::new(bounds(&used));
        let mut projected = 0;
        let mut numbers = HashMap::new();
        let mut vertices = Vec::new();
        let mut triangles = Vec::with_capacity(self.triangles.len());
        for triangle in &self.triangles {
            let is_bare = triangle.iter().any(|&vertex| self.texture_coordinates[vertex as usize].is_none());
            let side = is_bare.then(|| Side::facing(doubled_area(&self.positions, *triangle)));
            projected += usize::from(is_bare);
            triangles.push(triangle.map(|vertex| {
                *numbers.entry((vertex, side)).or_insert_with(|| {
                    vertices.push((vertex as usize, side));
                    // There are at most three corners for each of 2^24 triangles.
                    u32::try_from(vertices.len() - 1).unwrap_or(u32::MAX)
                })
            }));
        }
        if projected > 0 {
            warnings.push(format!(
                "{projected} of {} triangles have no texture coordinates: they were projected from the sides of a box, {PIECES} pieces of the \
                 material over the mesh's largest extent",
                triangles.len()
            ));
        }
        let positions = vertices.iter().map(|&(vertex, _)| self.positions[vertex]).collect();
        let unit: Vec<_> = vertices.iter().map(|&(vertex, _)| normals[vertex].as_vec3().to_array()).collect();
        let texture = |&(vertex, side): &(usize, Option<Side>)| match side {
            Some(side) => projection.place(self.positions[vertex], side),
            None => self.texture_coordinates[vertex].unwrap_or_default(),
        };
        let texture = vertices.iter().map(texture).collect();
        let given = vertices.iter().zip(&unit).map(|((vertex, side), normal)| {
            let kept = self.tangents[*vertex].filter(|_| side.is_none() && self.normals[*vertex].is_some());
            kept.map(|tangent| across(*normal, tangent))
        });
        if let Some(tangents) = given.collect() {
            return Ok(Mesh::new(positions, unit, tangents, texture, triangles)?);
        }
        let (mesh, directionless) = Mesh::with_tangents(positions, unit, texture, triangles)?;
        if directionless > 0 {
            warnings.push(format!(
                "{directionless} of {} triangles have no area in texture coordinates: the material lies on them in any direction",
                mesh.triangles().len()
            ));
        }
        Ok(mesh)
    }
}

/// A side of a box: the axis its normal is along, and whether against it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
struct Side {
    axis: usize,
    is_negative: bool,
}

impl Side {
    /// The side that faces a direction most; of equal axes the first.
    fn facing(direction: DVec3) -> Self {
        let direction = direction.to_array();
        let axis = (1..3).fold(0, |best, axis| if direction[axis].abs() > direction[best].abs() { axis } else { best });
        Self { axis, is_negative: direction[axis] < 0.0 }
    }

    /// The axes along which u and v grow, seen upright from outside: y is up on four sides; on top up is away from the viewer, who looks
    /// along -z, and below toward it.
    fn axes(self) -> [DVec3; 2] {
        let sign = if self.is_negative { -1.0 } else { 1.0 };
        match self.axis {
            0 => [-sign * DVec3::Z, DVec3::Y],
            1 => [DVec3::X, -sign * DVec3::Z],
            _ => [sign * DVec3::X, DVec3::Y],
        }
    }
}

/// From positions to texture coordinates on the sides of a box.
struct Projection {
    low: DVec3,
    piece: f64,
}

impl Projection {
    fn new(bounds: [[f32; 3]; 2]) -> Self {
        let [low, high] = bounds.map(vector);
        Self { low, piece: (high - low).max_element() / PIECES }
    }

    fn place(&self, position: [f32; 3], side: Side) -> [f32; 2] {
        #[expect(clippy::cast_possible_truncation, reason = "rounds")]
        side.axes().map(|axis| ((vector(position) - self.low).dot(axis) / self.piece) as f32)
    }
}

/// One of the array's values for each vertex, or none.
fn each<T>(values: Option<Vec<T>>, vertices: usize) -> impl Iterator<Item = Option<T>> {
    let mut values = values.map(Vec::into_iter);
    (0..vertices).map(move |_| values.as_mut().and_then(Iterator::next))
}

fn vector(value: [f32; 3]) -> DVec3 {
    DVec3::from_array(value.map(f64::from))
}
