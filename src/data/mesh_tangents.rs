//! Tangents for meshes without: Mikkelsen 2008, "Simulation of wrinkled surfaces revisited", by the crate `bevy_mikktspace`, so that a mesh
//! has the tangents here that other tools give it.

use std::collections::HashMap;

use bevy_mikktspace::{Geometry, TangentSpace, generate_tangents};
use glam::DVec3;

use super::mesh::{self, Mesh, MeshError, places};

/// The most triangles that may meet at a place: for each the library looks at all others there, and descends one call deeper.
const MAX_TRIANGLES_AT_A_PLACE: u32 = 1024;

impl Mesh {
    /// A mesh with tangents along growing u, and the number of triangles at which u grows nowhere, whose tangents are just any. A vertex
    /// becomes several where its triangles disagree about the tangent, such as where the material is mirrored.
    ///
    /// # Errors
    /// [`MeshError`] as [`Mesh::new`], and if more than 1024 triangles meet at a place.
    pub fn with_tangents(
        positions: Vec<[f32; 3]>, normals: Vec<[f32; 3]>, texture_coordinates: Vec<[f32; 2]>, triangles: Vec<[u32; 3]>,
    ) -> Result<(Self, usize), MeshError> {
        mesh::check(&positions, &normals, &texture_coordinates, &triangles)?;
        is_not_crowded(&positions, &triangles)?;
        let mut corners = Corners {
            positions: scaled(&positions),
            normals: &normals,
            texture_coordinates: scaled(&texture_coordinates),
            triangles: &triangles,
            tangents: vec![None; 3 * triangles.len()],
        };
        // The library's error has no cases.
        generate_tangents(&mut corners).ok();
        let mut directionless = 0;
        let tangents = std::mem::take(&mut corners.tangents);
        let mut numbers = HashMap::new();
        let mut of = Vec::with_capacity(positions.len());
        let mut split = Vec::with_capacity(triangles.len());
        for (triangle, found) in triangles.iter().zip(tangents.chunks_exact(3)) {
            directionless += usize::from(found.iter().any(Option::is_none));
            split.push(std::array::from_fn(|corner| {
                let vertex = triangle[corner];
                let tangent = across(normals[vertex as usize], found[corner].unwrap_or_default());
                *numbers.entry((vertex, tangent.map(f32::to_bits))).or_insert_with(|| {
                    of.push((vertex as usize, tangent));
                    // There are at most three corners for each of 2^24 triangles.
                    u32::try_from(of.len() - 1).unwrap_or(u32::MAX)
                })
            }));
        }
        let mesh = Self::new(
            of.iter().map(|&(vertex, _)| positions[vertex]).collect(),
            of.iter().map(|&(vertex, _)| normals[vertex]).collect(),
            of.iter().map(|&(_, tangent)| tangent).collect(),
            of.iter().map(|&(vertex, _)| texture_coordinates[vertex]).collect(),
            split,
        )?;
        Ok((mesh, directionless))
    }
}

/// What the library sees: corners of triangles, no vertices.
struct Corners<'a> {
    positions: Vec<[f32; 3]>,
    normals: &'a [[f32; 3]],
    texture_coordinates: Vec<[f32; 2]>,
    triangles: &'a [[u32; 3]],
    /// `[triangle][corner]`
    tangents: Vec<Option<[f32; 4]>>,
}

impl Geometry for Corners<'_> {
    fn num_faces(&self) -> usize {
        self.triangles.len()
    }

    fn num_vertices_of_face(&self, _: usize) -> usize {
        3
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        self.positions[self.triangles[face][corner] as usize]
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        self.normals[self.triangles[face][corner] as usize]
    }

    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        self.texture_coordinates[self.triangles[face][corner] as usize]
    }

    fn set_tangent(&mut self, tangent: Option<TangentSpace>, face: usize, corner: usize) {
        self.tangents[3 * face + corner] = tangent.map(|tangent| tangent.tangent_encoded()).filter(|tangent| tangent[..3] != [0.0; 3]);
    }
}

/// Values times the power of two that brings the largest near 1: that rounds nothing, and keeps areas within single precision.
fn scaled<const N: usize>(values: &[[f32; N]]) -> Vec<[f32; N]> {
    let largest = values.iter().flatten().fold(f32::MIN_POSITIVE, |largest, value| largest.max(value.abs()));
    // An f32 without its fraction is the power of two below it; one of the smallest has no reciprocal.
    let power = f32::from_bits(largest.to_bits() & 0x7f80_0000).max(1e-37);
    values.iter().map(|value| value.map(|value| value / power)).collect()
}

fn is_not_crowded(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    let (places, count) = places(positions);
    let mut meeting = vec![0_u32; count as usize];
    for &vertex in triangles.iter().flatten() {
        meeting[places[vertex as usize] as usize] += 1;
    }
    let crowded = (0..positions.len()).find(|&vertex| meeting[places[vertex] as usize] > MAX_TRIANGLES_AT_A_PLACE);
    crowded.map_or(Ok(()), |vertex| {
        let triangles = meeting[places[vertex] as usize];
        Err(MeshError::Crowded { place: positions[vertex], triangles, most: MAX_TRIANGLES_AT_A_PLACE })
    })
}

/// The part of a tangent that is across a unit normal, of length 1; if there is none, any direction across.
#[must_use]
pub fn across(normal: [f32; 3], [x, y, z, w]: [f32; 4]) -> [f32; 4] {
    let normal = DVec3::from_array(normal.map(f64::from)).normalize();
    let tangent = DVec3::new(x.into(), y.into(), z.into());
    let rest = tangent - tangent.dot(normal) * normal;
    // What is shorter than this beside the whole is rounding.
    let unit = if rest.length() > 1e-5 * tangent.length() { rest.normalize() } else { normal.any_orthonormal_vector() };
    let [x, y, z] = unit.as_vec3().to_array();
    [x, y, z, if w < 0.0 { -1.0 } else { 1.0 }]
}
