//! Twin of `lpca_weights`.

/// Σ (m + Σ_c w_c e_c − x)² and Σ x² over the values that are not masked.
#[must_use]
pub fn lpca_weights(texel: &[Option<f64>], mean: &[f64], eigenvectors: &[Vec<f64>], weights: &[f64]) -> [f64; 2] {
    let mut sums = [0.0; 2];
    for (value, x) in texel.iter().enumerate().filter_map(|(value, x)| x.map(|x| (value, x))) {
        let model = mean[value] + eigenvectors.iter().zip(weights).map(|(e, w)| w * e[value]).sum::<f64>();
        sums[0] += (model - x).powi(2);
        sums[1] += x.powi(2);
    }
    sums
}
