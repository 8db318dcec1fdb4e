//! Twin of `lobe_residual`.

use crate::{
    data::Direction,
    model::{lafortune, product_in_frame},
};

/// Mean radiance less shading times (ρ_d + Σ ρ_s·lobe), all means over the channels; 0 where unlit.
#[must_use]
pub fn lobe_residual(
    mean: f64, shading: f64, normal: [f64; 3], (view, light): (Direction, Direction), diffuse: f64, lobes: &[(f64, [f64; 4])],
) -> f64 {
    let product = product_in_frame(normal.into(), view.vector(), light.vector());
    let reflectance = diffuse + lobes.iter().map(|&(specular, lobe)| specular * lafortune(lobe, product)).sum::<f64>();
    if shading > 0.0 { mean - shading * reflectance } else { 0.0 }
}
