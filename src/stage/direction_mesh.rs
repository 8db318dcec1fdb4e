//! Meshes of directions in adapter memory (`kernels/common/direction_mesh.wgsl`).

use super::scalar::count;
use crate::data::DirectionMesh;

/// No triangle, as the kernel knows it.
const OUTSIDE: u32 = u32::MAX;

/// Cells a side of the grid at most.
const MAX_SIDE: usize = 64;

/// Appends a mesh to those of one buffer; returns where it begins and the cells a side of its grid, as the kernel's `DirectionMesh`.
pub fn pack_directions(mesh: &DirectionMesh, packed: &mut Vec<[u32; 4]>) -> [u32; 2] {
    let triangles = mesh.triangles();
    // Four triangles a cell, and whole elements of four cells.
    let side = (2 * (triangles.len() / 16).isqrt() + 2).min(MAX_SIDE);
    let first = count(packed.len());
    let cells: Vec<u32> = mesh.cells(side).into_iter().map(count).collect();
    packed.extend(cells.as_chunks().0);
    packed.extend(triangles.as_flattened().iter().map(|corner| {
        let [x, y] = corner.place.map(f32::to_bits);
        [x, y, count(corner.direction), corner.across.map_or(OUTSIDE, count)]
    }));
    [first, count(side)]
}
