//! Twin of `specular_residual`.

/// Mean over the channels of max(f − ρ_d, 0) (thesis section 3.2.2, steps 3 and 4); −1 of a masked (negative) reflectance.
#[must_use]
pub fn specular_residual(reflectance: [f64; 3], diffuse: [f64; 3]) -> f64 {
    if reflectance.iter().any(|f| *f < 0.0) {
        return -1.0;
    }
    reflectance.iter().zip(diffuse).map(|(f, rho)| (f - rho).max(0.0)).sum::<f64>() / 3.0
}
