//! Twin of `shade`: radiance along a view ray, from the papers' own formulas.

use glam::DVec3;

use super::relief::HeightField;
use crate::{
    data::{Direction, Map},
    model::{
        Boundary, Coat, Relief, lafortune,
        microfacet::{ggx_specular, schlick},
    },
};

/// A material as the renderer sees it: the maps of [`stage::Surface`](crate::stage::Surface) in f64.
#[derive(Debug, Clone)]
pub struct Surface {
    /// Texel widths, positive outwards, the paint's thickness included.
    pub heights: Map<f64>,
    /// Unit normals of `heights`.
    pub normals: Map<[f64; 3]>,
    /// ρ_d of the unpainted material.
    pub diffuse: Map<[f64; 3]>,
    /// ρ_s of the unpainted material.
    pub specular: Map<[f64; 3]>,
    /// (C_x, C_y, C_z, n).
    pub lobe: Map<[f64; 4]>,
    /// Kubelka-Munk reflectance; the fourth value is how much of the texel is painted.
    pub painted: Map<[f64; 4]>,
    /// What stands beyond the edge.
    pub boundary: Boundary,
    /// Surface of the paint.
    pub coat: Coat,
}

/// Cosine below which a direction is taken for the horizon.
const HORIZON: f64 = 0.001;

impl Surface {
    /// The heights, ready for rays.
    pub(super) fn field(&self) -> HeightField<'_> {
        HeightField::new(&self.heights, self.boundary)
    }

    /// π·L_o/E along the view ray that crosses the base plane at `base` (column, row).
    pub(super) fn radiance(&self, field: &HeightField<'_>, base: [f64; 2], view: Direction, light: Direction, relief: Relief) -> [f64; 3] {
        let (view, light) = (view.vector(), light.vector());
        if view.z < HORIZON || light.z < HORIZON {
            return [0.0; 3];
        }
        let (place, height) = if relief.displace { field.first_hit(base, view) } else { (base, field.at(base)) };
        let visible = if relief.shadow { field.seen_share(place, height, light, relief.penumbra) } else { 1.0 };
        let mut radiance = [0.0; 3];
        for (texel, weight) in field.corners(place) {
            let coverage = self.painted[texel][3];
            let unpainted = self.unpainted(texel, view, light);
            let painted = self.painted(texel, view, light);
            for channel in 0..3 {
                radiance[channel] += weight * visible * ((1.0 - coverage) * unpainted[channel] + coverage * painted[channel]);
            }
        }
        radiance
    }

    /// Lafortune et al. 1997, thesis eq. 3.3, times cos θ_i of the base plane.
    fn unpainted(&self, texel: (usize, usize), view: DVec3, light: DVec3) -> [f64; 3] {
        let lobe = lafortune(self.lobe[texel], (view * light).to_array());
        std::array::from_fn(|channel| (self.diffuse[texel][channel] + self.specular[texel][channel] * lobe) * light.z)
    }

    /// Kubelka-Munk diffuse (1 − F(θ_i))(1 − F(θ_o))ρ/(1 − F̄) with Schlick's F (Kelemen, Szirmay-Kalos 2001), normals turned from
    /// the view further than the base plane counted as that plane, and the coat's facets on top.
    fn painted(&self, texel: (usize, usize), view: DVec3, light: DVec3) -> [f64; 3] {
        let normal = DVec3::from_array(self.normals[texel]);
        let (alpha, f0) = (self.coat.alpha(), self.coat.f0());
        let specular = ggx_specular(normal, view, light, alpha, f0);
        let (cosine_view, cosine_light) = (normal.dot(view), normal.dot(light).max(0.0));
        // Mean over the hemisphere, weighted by the cosine: ∫ 2c(1 − c)⁵ dc = 1/21.
        let fresnel_mean = f0 + (1.0 - f0) / 21.0;
        let entering = (1.0 - schlick(f0, cosine_light)) * (1.0 - schlick(f0, cosine_view.max(view.z))) / (1.0 - fresnel_mean);
        std::array::from_fn(|channel| entering * self.painted[texel][channel] * cosine_light + specular)
    }
}
