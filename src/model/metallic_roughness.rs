//! What a texel is to tools that know a diffuse part under one GGX lobe, as glTF 2.0 has it (its appendix B, with the extension
//! `KHR_materials_specular`): π f_r = (1 − F) base + F D G π/(4 cos θ_i cos θ_o), F = F₀ + (F₉₀ − F₀)(1 − cos θ_d)⁵.
//!
//! The parts of a texel, bare and painted, are brought to that form by what they reflect in all of light from everywhere, so that a part
//! is as bright there as here: such light meets F with the mean F₀ + (F₉₀ − F₀)/21. Paint is of that form already. A Lafortune lobe becomes
//! a surface of refractive index 1.5, F₀ = 0.04, in such a share of the texel that both reflect the same; where it reflects more than all of
//! that, F₀ rises. Its width is α² = 2/(n + 2), what Walter et al. 2007 have for Blinn's exponent n. The exponent here is about the
//! mirrored direction, whose lobes are half as wide at the normal and spread toward the horizon; over all pairs of directions up to 75
//! degrees this α leaves less than that of the same curvature at the normal does.
//!
//! In these terms both parts mix linearly by coverage.

use super::{PaintMethod, lafortune_albedo};

/// F₀ of refractive index 1.5, which glTF has where nothing else is said.
pub const DIELECTRIC: f64 = 0.04;

/// A diffuse part under a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MetallicRoughness {
    /// Diffuse reflectance per channel of what the surface lets through; above 1 where it cannot make up for what the surface keeps.
    pub base_color: [f64; 3],
    /// Reflectance of the surface at normal incidence per channel.
    pub f0: [f64; 3],
    /// Reflectance of the surface at grazing incidence, 0 to 1.
    pub f90: f64,
    /// α of its facets' GGX distribution, 0 to 1; 1 where nothing is reflected.
    pub alpha: f64,
}

/// A part of a texel, in terms that mix linearly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Part {
    /// Share of light from everywhere that comes back diffusely, per channel.
    diffuse: [f64; 3],
    f0: [f64; 3],
    f90: f64,
    /// Share of light from everywhere that lobes reflect, mean of the channels, and the sum of it times their α².
    reflected: f64,
    spread: f64,
}

/// Share of light from everywhere that a surface reflects, without what its facets do to each other.
fn mean_fresnel(f0: f64, f90: f64) -> f64 {
    f0 + (f90 - f0) / 21.0
}

fn mean(rgb: [f64; 3]) -> f64 {
    rgb.iter().sum::<f64>() / 3.0
}

impl Part {
    /// Bare material: ρ_d, and ρ_s and (C_x, C_y, C_z, n) of its lobes.
    #[must_use]
    pub fn bare(diffuse: [f64; 3], lobes: impl IntoIterator<Item = ([f64; 3], [f64; 4])>) -> Self {
        let mut albedo = [0.0; 3];
        let (mut reflected, mut spread) = (0.0, 0.0);
        for (specular, lobe) in lobes {
            let share = lafortune_albedo(lobe);
            let of_lobe = specular.map(|specular| specular * share);
            albedo = std::array::from_fn(|channel| albedo[channel] + of_lobe[channel]);
            reflected += mean(of_lobe);
            spread += mean(of_lobe) * 2.0 / (lobe[3] + 2.0);
        }
        let f90 = (mean(albedo) / mean_fresnel(DIELECTRIC, 1.0)).min(1.0);
        // mean_fresnel solved for F0; a channel that reflects less than the others do at grazing incidence has none.
        let f0 = albedo.map(|albedo| ((21.0 * albedo - f90) / 20.0).max(0.0));
        Self { diffuse, f0, f90, reflected, spread }
    }

    /// Paint of this reflectance; F₀ and α of its surface. A colour that is blended in has no surface.
    #[must_use]
    pub fn painted(method: PaintMethod, reflectance: [f64; 3], [f0, alpha]: [f64; 2]) -> Self {
        match method {
            PaintMethod::AlphaBlend => Self { diffuse: reflectance, f0: [0.0; 3], f90: 0.0, reflected: 0.0, spread: 0.0 },
            PaintMethod::KubelkaMunk => {
                let reflected = mean_fresnel(f0, 1.0);
                let diffuse = reflectance.map(|reflectance| (1.0 - reflected) * reflectance);
                Self { diffuse, f0: [f0; 3], f90: 1.0, reflected, spread: reflected * alpha * alpha }
            }
        }
    }

    /// `share` of `other` beside the rest of this one.
    #[must_use]
    pub fn mixed(self, other: Self, share: f64) -> Self {
        let mix = |a: f64, b: f64| a + share * (b - a);
        let each = |a: [f64; 3], b: [f64; 3]| std::array::from_fn(|channel| mix(a[channel], b[channel]));
        Self {
            diffuse: each(self.diffuse, other.diffuse),
            f0: each(self.f0, other.f0),
            f90: mix(self.f90, other.f90),
            reflected: mix(self.reflected, other.reflected),
            spread: mix(self.spread, other.spread),
        }
    }
}

/// A part that is all of the texel.
impl From<Part> for MetallicRoughness {
    fn from(Part { diffuse, f0, f90, reflected, spread }: Part) -> Self {
        // The surface keeps from all channels what it reflects of the brightest.
        let kept = f0.into_iter().map(|f0| mean_fresnel(f0, f90)).fold(0.0, f64::max);
        let let_through = (1.0 - kept).max(f64::MIN_POSITIVE);
        let alpha = if reflected > 0.0 { (spread / reflected).sqrt().min(1.0) } else { 1.0 };
        Self { base_color: diffuse.map(|diffuse| diffuse / let_through), f0, f90, alpha }
    }
}
