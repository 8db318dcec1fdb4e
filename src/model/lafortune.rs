//! The Lafortune lobe.

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
