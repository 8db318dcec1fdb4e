//! Samples whose reflectance stands in the frame of a normal, as `linear_refit` and `radiance_error` see them.

use glam::DVec3;

use crate::model::{lafortune, product_in_frame};

/// One sample of one texel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocalSample {
    /// Unit vector towards the viewer.
    pub view: DVec3,
    /// Unit vector towards the light.
    pub light: DVec3,
    /// Unit normal of what the view sees.
    pub normal: DVec3,
    /// cos θ_i against the normal times the share of the light that reaches the point; 0 where unlit.
    pub shading: f64,
    /// Of each channel, reflectance units; negative where masked.
    pub radiance: [f64; 3],
}

impl LocalSample {
    /// Whether the measurement takes part in nothing.
    #[must_use]
    pub fn is_masked(&self) -> bool {
        self.radiance.iter().any(|radiance| *radiance < 0.0)
    }

    /// What ρ = 1 of the diffuse part, then of each lobe (C_x, C_y, C_z, n), would have sent to the viewer.
    #[must_use]
    pub fn responses(&self, lobes: &[[f64; 4]]) -> Vec<f64> {
        let product = product_in_frame(self.normal, self.view, self.light);
        let lobes = lobes.iter().map(|lobe| lafortune(*lobe, product));
        std::iter::once(1.0).chain(lobes).map(|value| self.shading * value).collect()
    }
}
