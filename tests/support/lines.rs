//! Texels as vectors of all their samples, in the order of lines.

use overpaint::data::OCTET;

use super::random::Random;

/// A vector whose value is `value(channel, sample)`, 0 past the last sample.
pub fn vector(samples: usize, octets: usize, mut value: impl FnMut(usize, usize) -> f64) -> Vec<f64> {
    let padded = octets * OCTET;
    (0..3 * padded).map(|index| if index % padded < samples { value(index / padded, index % padded) } else { 0.0 }).collect()
}

/// The vector of a texel of what [`tile::unpack`](super::tile::unpack) gave; none where it is masked.
pub fn texel(given: &[f64], texels: usize, texel: usize) -> Vec<Option<f64>> {
    given.iter().skip(texel).step_by(texels).map(|&value| (value >= 0.0).then_some(value)).collect()
}

/// Orthonormal vectors of numbers that single precision holds, by Gram and Schmidt.
pub fn orthonormal(random: &mut Random, vectors: usize, length: usize) -> Vec<Vec<f64>> {
    let mut found: Vec<Vec<f64>> = Vec::new();
    while found.len() < vectors.min(length) {
        let mut vector: Vec<f64> = (0..length).map(|_| random.between(-1.0, 1.0)).collect();
        for other in found.iter().chain(&found.clone()) {
            let product: f64 = vector.iter().zip(other).map(|(a, b)| a * b).sum();
            vector.iter_mut().zip(other).for_each(|(a, b)| *a -= product * b);
        }
        let norm = vector.iter().map(|a| a * a).sum::<f64>().sqrt();
        if norm > 1e-3 {
            found.push(vector.into_iter().map(|a| f64::from((a / norm) as f32)).collect());
        }
    }
    found
}
