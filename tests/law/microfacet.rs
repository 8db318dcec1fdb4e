use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec3;
use overpaint::model::microfacet::{ggx, ggx_specular, normal_reflectance};

use crate::support::hold;

crate::suite! { plain: normal_reflectance_is_fresnels, facets_cover_the_plane, a_white_furnace_gains_nothing, light_and_view_can_be_swapped, nothing_below_the_horizon; }

fn direction(theta: f64, phi: f64) -> DVec3 {
    DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos())
}

fn normal_reflectance_is_fresnels() {
    for (index, expected) in [(1.0, 0.0), (1.33, 0.0201), (1.5, 0.04), (1.6, 0.0533)] {
        hold("microfacet: F0", (normal_reflectance(index) - expected).abs(), 5e-5);
    }
}

/// Facets projected onto the plane cover it once: the integral of D cos θ over the hemisphere is 1 (Walter et al. 2007 eq. 4).
fn facets_cover_the_plane() {
    for roughness in [0.02_f64, 0.1, 0.3, 0.7, 1.0] {
        // In u = tan θ / α the integrand is smooth for every roughness; θ from 0 to 90° is u from 0 to infinity, u = v/(1 - v).
        let steps = 20_000;
        let sum: f64 = (0..steps)
            .map(|step| {
                let v = (f64::from(step) + 0.5) / f64::from(steps);
                let tangent = roughness * v / (1.0 - v);
                let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
                let d_theta = cosine * cosine * roughness / (1.0 - v).powi(2) / f64::from(steps);
                ggx(roughness, cosine) * cosine * (1.0 - cosine * cosine).sqrt() * d_theta * TAU
            })
            .sum();
        // The midpoint rule with 2e4 steps.
        hold("microfacet: integral of D", (sum - 1.0).abs(), 1e-6);
    }
}

/// With F = 1 everywhere, what comes back is what came in less what would have been reflected twice: never more than 1, and
/// nearly 1 for a smooth surface seen from above.
fn a_white_furnace_gains_nothing() {
    for roughness in [0.05, 0.1, 0.3, 0.6, 1.0] {
        for degrees in [0.0_f64, 30.0, 60.0, 80.0, 88.0] {
            let view = direction(degrees.to_radians(), 0.0);
            // Over θ and φ of the half vector, where the lobe is centred: dω_i = 4 (ω_o·h) dω_h.
            let (rings, spokes) = (1500, 120);
            let mut albedo = 0.0;
            for ring in 0..rings {
                // Rings dense where the facets are: tan θ = α v/(1 - v).
                let v = (f64::from(ring) + 0.5) / f64::from(rings);
                let tangent = roughness * v / (1.0 - v);
                let d_theta = roughness / (1.0 - v).powi(2) / (1.0 + tangent * tangent) / f64::from(rings);
                for spoke in 0..spokes {
                    let half = direction(tangent.atan(), TAU * (f64::from(spoke) + 0.5) / f64::from(spokes));
                    let light = 2.0 * view.dot(half) * half - view;
                    if view.dot(half) > 0.0 {
                        let value = ggx_specular(DVec3::Z, view, light, roughness, 1.0) / PI;
                        albedo += value * 4.0 * view.dot(half) * tangent.atan().sin() * d_theta * TAU / f64::from(spokes);
                    }
                }
            }
            // The quadrature's own error.
            hold("microfacet: furnace, albedo - 1", albedo - 1.0, 1e-3);
            if degrees <= 30.0 && roughness <= 0.1 {
                // Facets of slope 0.1 hide each other to about their slope squared.
                hold("microfacet: furnace, 1 - albedo of a smooth surface", 1.0 - albedo, 0.02);
            }
        }
    }
}

/// f_r(ω_i, ω_o) = f_r(ω_o, ω_i) (Helmholtz).
fn light_and_view_can_be_swapped() {
    for index in 0..200 {
        let step = f64::from(index);
        let (a, b) = (direction(FRAC_PI_2 * (step * 0.618).fract(), step), direction(FRAC_PI_2 * (step * 0.414).fract(), 2.3 * step));
        let roughness = 0.05 + 0.95 * (step * 0.73).fract();
        let forth = ggx_specular(DVec3::Z, a, b, roughness, 0.04) / b.z;
        let back = ggx_specular(DVec3::Z, b, a, roughness, 0.04) / a.z;
        hold("microfacet: reciprocity", (forth - back).abs() / (1.0 + forth), 1e-12);
    }
}

fn nothing_below_the_horizon() {
    let (above, below) = (direction(0.5, 0.0), direction(1.7, 2.0));
    assert_eq!(ggx_specular(DVec3::Z, above, below, 0.3, 0.04), 0.0);
    assert_eq!(ggx_specular(DVec3::Z, below, above, 0.3, 0.04), 0.0);
}
