//! Twin of the mesh passes: a ray a pixel, cut with every triangle; of the points met in the relief the nearest is seen, of a
//! closed mesh's outer sides alone if it is seen from outside.

use glam::{DQuat, DVec3};

use super::{CompressedBtf, Surface, environment_prefiltered, environment_source};
use crate::{
    data::{Direction, Light, Map, Mesh, MeshView},
    model::ENVIRONMENT_SOURCE,
};

/// A view counts as this low above the base plane at least.
const LOWEST_VIEW: f64 = 0.02;
/// Cosine of a view from which on the relief's depth counts less.
const OUTLINE: f64 = 0.5;

/// What a mesh wears.
#[derive(Debug, Clone, Copy)]
pub struct Worn<'a> {
    /// The material.
    pub surface: &'a Surface,
    /// What its bare part is made from, if it is the local PCA.
    pub compressed: Option<&'a CompressedBtf<'a>>,
}

/// RGB (π·L_o/E) and 1 in each pixel of `view`, whose mesh wears `worn`, 0 in the others. Shadows are sharp.
#[must_use]
#[expect(clippy::cast_precision_loss, reason = "columns and rows of a picture and of a material")]
pub fn mesh(view: &MeshView, worn: Worn<'_>) -> Map<[f64; 4]> {
    let MeshView { mesh, tiling, camera, lights, shadows, relief, .. } = view;
    let field = worn.surface.field();
    let size = [worn.surface.heights.width() as f64, worn.surface.heights.height() as f64];
    let vector = |values: [f32; 3]| DVec3::from_array(values.map(f64::from));
    let place = |vertex: usize| {
        let [u, v] = mesh.texture_coordinates()[vertex].map(f64::from);
        [u * tiling[0] * size[0] - 0.5, (1.0 - v) * tiling[1] * size[1] - 0.5]
    };
    let outer_only = mesh.is_closed() && !view.silhouette && camera.is_before(mesh.ball());
    let source = view
        .surroundings
        .as_ref()
        .map_or_else(|| Map::from_fn(1, 1, |_, _| [0.0; 3]), |around| environment_source(&around.environment, ENVIRONMENT_SOURCE));
    Map::from_fn(camera.size[0] as usize, camera.size[1] as usize, |column, row| {
        let [origin, direction] = camera.ray([column as f64 + 0.5, row as f64 + 0.5]);
        let mut nearest = (f64::INFINITY, [0.0; 4]);
        for triangle in mesh.triangles() {
            let corners = triangle.map(|corner| corner as usize);
            let [a, b, c] = corners.map(|corner| vector(mesh.positions()[corner]));
            let across = (b - a).cross(c - a);
            let along = across.dot(direction);
            if along == 0.0 || (outer_only && along > 0.0) {
                continue;
            }
            let distance = across.dot(a - origin) / along;
            let at = origin + distance * direction;
            // Areas of the parts that the point cuts the triangle into.
            let shares = [(b, c), (c, a), (a, b)].map(|(from, to)| (to - from).cross(at - from).dot(across) / across.length_squared());
            if distance <= 0.0 || shares.iter().any(|&share| share < 0.0) {
                continue;
            }
            let mixed = |of: &dyn Fn(usize) -> DVec3| corners.iter().zip(shares).map(|(&corner, share)| share * of(corner)).sum::<DVec3>();
            let outside = mixed(&|corner| vector(mesh.normals()[corner])).normalize();
            let tangent = mixed(&|corner| {
                let [x, y, z, _] = mesh.tangents()[corner];
                vector([x, y, z])
            });
            let tangent = (tangent - tangent.dot(outside) * outside).normalize();
            let bitangent = f64::from(mesh.tangents()[corners[0]][3]) * outside.cross(tangent);
            let normal = if along < 0.0 { outside } else { -outside };
            let in_base = |v: DVec3| DVec3::new(tangent.dot(v), bitangent.dot(v), normal.dot(v));
            let mut toward = in_base(-direction);
            toward.z = toward.z.max(LOWEST_VIEW);
            let toward = toward.normalize();
            let places = corners.map(place);
            let base = [0, 1].map(|axis| places.iter().zip(shares).map(|(place, share)| share * place[axis]).sum::<f64>());
            let edge = |corner: usize| [0, 1].map(|axis| places[corner][axis] - places[0][axis]);
            let ([x1, y1], [x2, y2]) = (edge(1), edge(2));
            let texel_width = (across.length() / (x1 * y2 - x2 * y1).abs()).sqrt();
            let height = if relief.displace { field.first_hit(base, toward).1 } else { field.at(base) };
            let met = distance - height * texel_width * (1.0 / toward.z).min(toward.z / (OUTLINE * OUTLINE));
            if met >= nearest.0 {
                continue;
            }
            let mut value = [0.0, 0.0, 0.0, 1.0];
            for light in lights {
                let (way, irradiance) = match *light {
                    Light::Directional { toward, irradiance } => (toward, irradiance),
                    Light::Point { place, irradiance } => (place - at, irradiance.map(|value| value / (place - at).length_squared())),
                };
                // From a little above the surface, towards the light and no further.
                let from = at + 1e-4 * normal;
                let reach = if let Light::Point { .. } = light { way.length() } else { f64::INFINITY };
                if *shadows && is_hidden(mesh, from, way.normalize(), reach) {
                    continue;
                }
                let radiance = radiance(view, worn, base, toward, in_base(way.normalize()));
                (0..3).for_each(|channel| value[channel] += irradiance[channel] * radiance[channel]);
            }
            if let Some(surroundings) = &view.surroundings {
                let (place, _) = field.first_hit(base, toward);
                let seen = worn.surface.surrounded(&field, place, toward, &|direction: DVec3, roughness| {
                    let [x, y, z] = direction.to_array();
                    let of_world = x * tangent + y * bitangent + z * normal;
                    environment_prefiltered(&source, roughness, DQuat::from_rotation_y(-surroundings.turn) * of_world)
                });
                (0..3).for_each(|channel| value[channel] += surroundings.strength * seen[channel]);
            }
            nearest = (met, value);
        }
        nearest.1
    })
}

/// Whether a triangle stands in the way of a ray, nearer than `reach` (Moeller, Trumbore 1997).
fn is_hidden(mesh: &Mesh, origin: DVec3, direction: DVec3, reach: f64) -> bool {
    mesh.triangles().iter().any(|triangle| {
        let [a, b, c] = triangle.map(|corner| DVec3::from_array(mesh.positions()[corner as usize].map(f64::from)));
        let (ab, ac) = (b - a, c - a);
        let across = direction.cross(ac);
        let determinant = ab.dot(across);
        let from = origin - a;
        let u = from.dot(across) / determinant;
        let turned = from.cross(ab);
        let v = direction.dot(turned) / determinant;
        let distance = ac.dot(turned) / determinant;
        u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0 && distance < reach
    })
}

/// π·L_o/E of the view ray through `base` under a light, both in the frame of the base plane.
fn radiance(view: &MeshView, worn: Worn<'_>, base: [f64; 2], toward: DVec3, light: DVec3) -> [f64; 3] {
    let field = worn.surface.field();
    let (Some(compressed), Some(samples)) = (worn.compressed, view.unpainted) else {
        return worn.surface.radiance(&field, base, toward, light, view.relief);
    };
    let (painted, bare) = worn.surface.painted_radiance(&field, base, toward, light, view.relief);
    if light.z < 0.001 {
        return [0.0; 3];
    }
    let original = compressed.radiance(base, samples, Direction::from_vector(toward), Direction::from_vector(light));
    std::array::from_fn(|channel| painted[channel] + bare * original[channel])
}
