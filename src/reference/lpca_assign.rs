//! Twin of `lpca_assign`.

/// A texel against one cluster: the squared length of what is left when its part along each of the orthonormal `eigenvectors` is taken away, and its
/// weights.
#[must_use]
pub fn lpca_assign(coordinates: &[f64], mean: &[f64], eigenvectors: &[Vec<f64>]) -> (f64, Vec<f64>) {
    let about: Vec<f64> = coordinates.iter().zip(mean).map(|(a, m)| a - m).collect();
    let weights: Vec<f64> = eigenvectors.iter().map(|e| e.iter().zip(&about).map(|(e, d)| e * d).sum()).collect();
    let inside = |index: usize| eigenvectors.iter().zip(&weights).map(|(e, w)| w * e[index]).sum::<f64>();
    (about.iter().enumerate().map(|(index, d)| (d - inside(index)).powi(2)).sum(), weights)
}
