//! Twin of `lpca_project`.

/// A texel's products with each vector of `basis` about `centre`, and its energy there, Σ_d s_d (x_d − c_d)². Masked values count as the centre.
#[must_use]
pub fn lpca_project(texel: &[Option<f64>], centre: &[f64], energy_weights: &[f64], basis: &[Vec<f64>]) -> (Vec<f64>, f64) {
    let about: Vec<f64> = texel.iter().zip(centre).map(|(x, c)| x.map_or(0.0, |x| x - c)).collect();
    let products = basis.iter().map(|vector| vector.iter().zip(&about).map(|(b, x)| b * x).sum()).collect();
    (products, energy_weights.iter().zip(&about).map(|(s, x)| s * x * x).sum())
}
