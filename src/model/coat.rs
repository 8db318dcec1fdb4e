//! The surface of a layer of paint.

use super::microfacet::normal_reflectance;

/// A clear, rough surface: what reflects the light that does not enter the paint.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Coat {
    /// Refractive index n of the paint's binder against air, about 1.5 to 2.2.
    pub refractive_index: f64,
    /// α of the facets' GGX distribution (Walter et al. 2007), 0 (a mirror) to 1.
    pub roughness: f64,
}

impl Coat {
    /// Reflectance at normal incidence, F₀ = ((n−1)/(n+1))².
    #[must_use]
    pub fn f0(self) -> f64 {
        normal_reflectance(self.refractive_index)
    }

    /// α as it is used: at least 0.01, since a mirror's lobe under a directional light is a point of infinite radiance.
    #[must_use]
    pub fn alpha(self) -> f64 {
        self.roughness.max(0.01)
    }
}

impl Default for Coat {
    /// Linseed oil, half gloss.
    fn default() -> Self {
        Self { refractive_index: 1.5, roughness: 0.3 }
    }
}
