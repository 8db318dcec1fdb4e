//! Reflection at a paint's surface: Schlick's Fresnel term on a GGX microfacet lobe, in f64. The f32 side is
//! `kernels/common/microfacet.wgsl`.
//!
//! No multiple scattering between facets: a rough surface reflects a little less than it receives.

use std::f64::consts::PI;

use glam::DVec3;

/// Reflectance at normal incidence of a dielectric in air: F₀ = ((n − 1)/(n + 1))² (Fresnel).
#[must_use]
pub fn normal_reflectance(refractive_index: f64) -> f64 {
    ((refractive_index - 1.0) / (refractive_index + 1.0)).powi(2)
}

/// Fresnel reflectance F₀ + (1 − F₀)(1 − cos θ)⁵ (Schlick 1994 eq. 15); `cosine` between light and microfacet.
#[must_use]
pub fn schlick(normal_reflectance: f64, cosine: f64) -> f64 {
    normal_reflectance + (1.0 - normal_reflectance) * (1.0 - cosine).powi(5)
}

/// Density of microfacet normals per steradian, `cosine` from the surface's normal (Walter et al. 2007 eq. 33, with
/// tan²θ = 1/cos²θ − 1 multiplied out): D = α²/(π(cos²θ(α² − 1) + 1)²).
#[must_use]
pub fn ggx(roughness: f64, cosine: f64) -> f64 {
    let alpha2 = roughness * roughness;
    alpha2 / (PI * (cosine * cosine * (alpha2 - 1.0) + 1.0).powi(2))
}

/// Fraction of facets that neither light nor view lose to their neighbours, divided by 4 cos θ_i cos θ_o: Smith's
/// height-correlated G₂ (Heitz 2014 eq. 99), 1/2 / (cos θ_i √(α² + (1 − α²)cos²θ_o) + cos θ_o √(α² + (1 − α²)cos²θ_i)).
#[must_use]
pub fn smith(roughness: f64, cosine_view: f64, cosine_light: f64) -> f64 {
    let alpha2 = roughness * roughness;
    let slope = |cosine: f64| (alpha2 + (1.0 - alpha2) * cosine * cosine).sqrt();
    0.5 / (cosine_light * slope(cosine_view) + cosine_view * slope(cosine_light))
}

/// Reflectance π·f_r·cos θ_i of the surface in reflectance units: the radiance towards `view` under irradiance π on a plane
/// facing `light`. 0 where view or light is below the horizon. All directions are unit vectors that point away.
#[must_use]
pub fn ggx_specular(normal: DVec3, view: DVec3, light: DVec3, roughness: f64, normal_reflectance: f64) -> f64 {
    let (cosine_view, cosine_light) = (normal.dot(view), normal.dot(light));
    if cosine_view <= 0.0 || cosine_light <= 0.0 {
        return 0.0;
    }
    let half = (view + light).normalize();
    let facets = ggx(roughness, normal.dot(half)) * smith(roughness, cosine_view, cosine_light);
    PI * schlick(normal_reflectance, light.dot(half)) * facets * cosine_light
}
