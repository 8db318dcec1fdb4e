//! Twin of `synth`: exact crossings of the rays, each with the whole list of patches below it.

use glam::{DMat3, DVec3};

use super::{normals, relief::HeightField};
use crate::{
    data::{Direction, Map},
    model::{Boundary, lafortune},
};

/// A known material: the maps of [`stage::SynthSurface`](crate::stage::SynthSurface) in f64.
#[derive(Debug, Clone)]
pub struct SynthSurface {
    /// Texel widths, positive outwards.
    pub heights: Map<f64>,
    /// ρ_d.
    pub diffuse: Map<[f64; 3]>,
    /// ρ_s.
    pub specular: Map<[f64; 3]>,
    /// (C_x, C_y, C_z, n) in the frame of the normal.
    pub lobe: Map<[f64; 4]>,
}

/// π·L_o/E of every texel of the base plane from `view` under `light`.
#[must_use]
#[expect(clippy::cast_precision_loss, reason = "columns and rows of a picture")]
pub fn synth(surface: &SynthSurface, view: Direction, light: Direction) -> Map<[f64; 3]> {
    let SynthSurface { heights, diffuse, specular, lobe } = surface;
    let field = HeightField::new(heights, Boundary::Periodic);
    let normals = normals(heights, Boundary::Periodic);
    let (view, light) = (view.vector(), light.vector());
    Map::from_fn(heights.width(), heights.height(), |column, row| {
        if view.z < 0.001 || light.z < 0.001 {
            return [0.0; 3];
        }
        let (place, height) = field.first_hit([column as f64, row as f64], view);
        let corners = field.corners(place);
        let normal: DVec3 = corners.iter().map(|&(texel, weight)| weight * DVec3::from_array(normals[texel])).sum();
        let normal = normal.normalize();
        // The plane's x, made orthogonal to the normal (Gram-Schmidt).
        let tangent = (DVec3::X - normal.x * normal).normalize();
        let frame = DMat3::from_cols(tangent, normal.cross(tangent), normal);
        let [to_view, to_light] = [view, light].map(|direction| frame.inverse() * direction);
        if to_light.z <= 0.0 || field.is_shadowed(place, height, light) {
            return [0.0; 3];
        }
        let nearest = corners.into_iter().max_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(texel, _)| texel).unwrap_or_default();
        let mirrored = if to_view.z > 0.0 { lafortune(lobe[nearest], (to_view * to_light).to_array()) } else { 0.0 };
        [0, 1, 2].map(|channel| (diffuse[nearest][channel] + specular[nearest][channel] * mirrored) * to_light.z)
    })
}
