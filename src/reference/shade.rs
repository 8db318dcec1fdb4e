//! Twin of `shade`: radiance along a view ray, from the papers' own formulas.

use glam::DVec3;

use super::{directional_albedo, relief::HeightField};
use crate::{
    data::Map,
    model::{
        Boundary, Frame, PaintMethod, Relief, lafortune,
        microfacet::{ggx_specular, schlick},
        product_in_frame,
    },
};

/// ρ_s and (C_x, C_y, C_z, n) of one lobe.
pub type LobeMaps = (Map<[f64; 3]>, Map<[f64; 4]>);

/// A material as the renderer sees it: the maps of [`stage::Surface`](crate::stage::Surface) in f64.
#[derive(Debug, Clone)]
pub struct Surface {
    /// Texel widths, positive outwards, the paint's thickness included.
    pub heights: Map<f64>,
    /// Unit normals of `heights`.
    pub normals: Map<[f64; 3]>,
    /// ρ_d of the unpainted material.
    pub diffuse: Map<[f64; 3]>,
    /// The frame that the unpainted material's reflectance is in.
    pub frame: Frame,
    /// Share of the base plane's light that reaches every point of the unpainted material by way of others.
    pub ambient: f64,
    /// ρ_s and (C_x, C_y, C_z, n) of each lobe of the unpainted material.
    pub lobes: Vec<LobeMaps>,
    /// Reflectance of the paint; the fourth value is how much of the texel is painted.
    pub painted: Map<[f64; 4]>,
    /// What stands beyond the edge.
    pub boundary: Boundary,
    /// F₀ and α of the paint's surface.
    pub coat: Map<[f64; 2]>,
    /// What the paint does to what lies below it.
    pub method: PaintMethod,
}

/// Texels around a place and their weights.
type Corners = [((usize, usize), f64); 4];

/// Cosine below which a direction is taken for the horizon.
const HORIZON: f64 = 0.001;

impl Surface {
    /// The heights, ready for rays.
    pub(super) fn field(&self) -> HeightField<'_> {
        HeightField::new(&self.heights, self.boundary)
    }

    /// π·L_o/E along the view ray that crosses the base plane at `base` (column, row).
    pub(super) fn radiance(&self, field: &HeightField<'_>, base: [f64; 2], view: DVec3, light: DVec3, relief: Relief) -> [f64; 3] {
        let (painted, bare) = self.painted_radiance(field, base, view, light, relief);
        if view.z < HORIZON || light.z < HORIZON {
            return [0.0; 3];
        }
        let (at_hit, visible) = self.met(field, base, view, light, relief);
        let normal_at = |corners: &Corners| {
            corners.iter().map(|&(texel, weight)| weight * DVec3::from_array(self.normals[texel])).sum::<DVec3>().normalize()
        };
        let at_base = field.corners(base);
        // Of a flat surface the reflectance moves with the relief; in a frame of its own it belongs to the place on the base plane.
        let (corners, normal, lit) = match self.frame {
            Frame::Plane => (at_hit, DVec3::Z, visible * light.z),
            Frame::Texel | Frame::Seen => {
                let (normal, seen) = if self.frame == Frame::Seen { (normal_at(&at_hit), visible) } else { (normal_at(&at_base), 1.0) };
                (at_base, normal, (1.0 - self.ambient) * seen * normal.dot(light).max(0.0) + self.ambient * light.z)
            }
        };
        let mut radiance = painted;
        for (texel, weight) in corners {
            let unpainted = self.unpainted(texel, normal, view, light, lit);
            (0..3).for_each(|channel| radiance[channel] += bare * weight * unpainted[channel]);
        }
        radiance
    }

    /// What the paint adds to it, and the share of the place that is bare.
    pub(super) fn painted_radiance(
        &self, field: &HeightField<'_>, base: [f64; 2], view: DVec3, light: DVec3, relief: Relief,
    ) -> ([f64; 3], f64) {
        if view.z < HORIZON || light.z < HORIZON {
            return ([0.0; 3], 1.0);
        }
        let (at_hit, visible) = self.met(field, base, view, light, relief);
        let (mut radiance, mut bare) = ([0.0; 3], 1.0);
        for (texel, weight) in at_hit {
            let [r, g, b, coverage] = self.painted[texel];
            let paint = match self.method {
                PaintMethod::KubelkaMunk => self.painted(texel, view, light, visible),
                PaintMethod::AlphaBlend => [r, g, b].map(|colour| colour * light.z),
            };
            (0..3).for_each(|channel| radiance[channel] += weight * coverage * paint[channel]);
            bare -= weight * coverage;
        }
        (radiance, bare)
    }

    /// What paint around a place sends to `view` of an environment, times its coverage; `environment` is the mean over a lobe of a roughness
    /// around a direction in the base plane's frame. What is mirrored of below that plane counts as dark.
    pub(super) fn surrounded(
        &self, field: &HeightField<'_>, place: [f64; 2], view: DVec3, environment: &dyn Fn(DVec3, f64) -> [f64; 3],
    ) -> [f64; 3] {
        let mut radiance = [0.0; 3];
        for (texel, weight) in field.corners(place) {
            let normal = DVec3::from_array(self.normals[texel]);
            let [f0, alpha] = self.coat[texel];
            let cosine = normal.dot(view);
            let leaving = 1.0 - schlick(f0, cosine.max(view.z));
            let mirror = 2.0 * cosine * normal - view;
            let [scale, bias] = directional_albedo(alpha, cosine.max(0.0), [60, 32]);
            let mirrored = (1.0 + mirror.z).clamp(0.0, 1.0) * (f0 * scale + bias);
            let (diffuse, specular) = (environment(normal, 1.0), environment(mirror, alpha));
            for channel in 0..3 {
                let paint = self.painted[texel][channel] * leaving * diffuse[channel] + mirrored * specular[channel];
                radiance[channel] += weight * self.painted[texel][3] * paint;
            }
        }
        radiance
    }

    /// The texels around the point that the ray meets, and the share of the light that it sees.
    fn met(&self, field: &HeightField<'_>, base: [f64; 2], view: DVec3, light: DVec3, relief: Relief) -> (Corners, f64) {
        let (place, height) = if relief.displace { field.first_hit(base, view) } else { (base, field.at(base)) };
        let visible = if relief.shadow { field.seen_share(place, height, light, relief.penumbra) } else { 1.0 };
        (field.corners(place), visible)
    }

    /// Lafortune et al. 1997, thesis eq. 3.3, in the frame of `normal`, times the light that is there.
    fn unpainted(&self, texel: (usize, usize), normal: DVec3, view: DVec3, light: DVec3, lit: f64) -> [f64; 3] {
        let product = product_in_frame(normal, view, light);
        std::array::from_fn(|channel| {
            let of_lobe = |(specular, lobe): &LobeMaps| specular[texel][channel] * lafortune(lobe[texel], product);
            (self.diffuse[texel][channel] + self.lobes.iter().map(of_lobe).sum::<f64>()) * lit
        })
    }

    /// Kubelka-Munk diffuse (1 − F(θ_i))(1 − F(θ_o))ρ/(1 − F̄) with Schlick's F (Kelemen, Szirmay-Kalos 2001), normals turned from
    /// the view further than the base plane counted as that plane, and the coat's facets on top, of the share `visible` of the light; and the
    /// same of light from everywhere, of which the mean of (1 − F)/(1 − F̄) enters: all.
    fn painted(&self, texel: (usize, usize), view: DVec3, light: DVec3, visible: f64) -> [f64; 3] {
        let normal = DVec3::from_array(self.normals[texel]);
        let [f0, alpha] = self.coat[texel];
        let specular = ggx_specular(normal, view, light, alpha, f0);
        let (cosine_view, cosine_light) = (normal.dot(view), normal.dot(light).max(0.0));
        // Mean over the hemisphere, weighted by the cosine: ∫ 2c(1 − c)⁵ dc = 1/21.
        let fresnel_mean = f0 + (1.0 - f0) / 21.0;
        let leaving = 1.0 - schlick(f0, cosine_view.max(view.z));
        let direct = (1.0 - self.ambient) * visible * cosine_light * (1.0 - schlick(f0, cosine_light)) / (1.0 - fresnel_mean);
        let around = self.ambient * light.z;
        std::array::from_fn(|channel| self.painted[texel][channel] * leaving * (direct + around) + visible * specular)
    }
}
