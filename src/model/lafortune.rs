//! The Lafortune lobe.

use std::f64::consts::{FRAC_PI_2, PI};

/// Most lobes of a texel.
pub const MAX_LOBES: usize = 3;

/// Fewest valid samples of a texel that a lobe is fitted to: C, n and ρ_d are five numbers, and a lobe through hardly more samples than
/// that follows their noise.
pub const MIN_LOBE_SAMPLES: u32 = 8;

/// Energy that a lobe must have over a texel's lit samples for a ρ_s of its own, as a part of the diffuse part's: Σ (c m)² over Σ c², c
/// the shading and m the lobe. A lobe that no sample has seen could have any ρ_s; one above has at most 10⁴ times the reflectance.
pub const MIN_LOBE_ENERGY: f64 = 1e-8;

/// (C·(ω_i ω_o))^n for `lobe` = (C_x, C_y, C_z, n) and the directions' `product` by components; 0 where the base is not
/// positive (Lafortune et al. 1997; thesis eq. 3.3).
#[must_use]
pub fn lafortune(lobe: [f64; 4], product: [f64; 3]) -> f64 {
    let base: f64 = lobe.iter().zip(product).map(|(c, p)| c * p).sum();
    if base > 0.0 { base.powf(lobe[3]) } else { 0.0 }
}

/// Share of light from everywhere that a lobe with ρ_s = 1 sends back: ∫∫ (C·(ω_i ω_o))^n cos θ_i cos θ_o dω_i dω_o / π², to 5 %.
///
/// For one ω_i the lobe is (c·ω_o)^n, c = (C_x x, C_y y, C_z z). About its axis, whose cosine to the normal is μ, its share is
/// 2μ/(n + 2) without the horizon, since ∫ (ĉ·ω)^n ω dω = 2π/(n + 2) ĉ; with it (μ + √(μ² + q²(1 − μ²)))/(n + 2), which is exact in
/// n = 0 and in the difference of μ and −μ. q²/(n + 2)² is the square of the share at μ = 0, q² = (Γ((n + 1)/2)/Γ(n/2 + 1))²/π, here
/// 2/(πn + 2). The mean over ω_i is taken at 32 directions of a quadrant.
#[must_use]
pub fn lafortune_albedo([cx, cy, cz, n]: [f64; 4]) -> f64 {
    const RINGS: u32 = 8;
    const SECTORS: u32 = 4;
    let mut sum = 0.0;
    for ring in 0..RINGS {
        let sin2 = (f64::from(ring) + 0.5) / f64::from(RINGS);
        for sector in 0..SECTORS {
            let cos2 = (FRAC_PI_2 * (f64::from(sector) + 0.5) / f64::from(SECTORS)).cos().powi(2);
            let length2 = sin2 * (cx * cx * cos2 + cy * cy * (1.0 - cos2)) + (1.0 - sin2) * cz * cz;
            if length2 > 0.0 {
                let cosine = cz * ((1.0 - sin2) / length2).sqrt();
                let horizon = (cosine * cosine + (1.0 - cosine * cosine) * 2.0 / (PI * n + 2.0)).sqrt();
                sum += length2.powf(0.5 * n) * (cosine + horizon) / (n + 2.0);
            }
        }
    }
    sum / f64::from(RINGS * SECTORS)
}
