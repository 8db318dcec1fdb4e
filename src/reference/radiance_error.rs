//! Twin of `radiance_error`.

use super::LocalSample;

/// The sums of (model − L)², L², model − L and L over the samples that are not masked and the channels, for `coefficients` ρ_d and
/// then the ρ_s of each of `lobes` (C_x, C_y, C_z, n).
#[must_use]
pub fn radiance_error(samples: &[LocalSample], coefficients: &[[f64; 3]], lobes: &[[f64; 4]]) -> [f64; 4] {
    let mut sums = [0.0; 4];
    for sample in samples.iter().filter(|sample| !sample.is_masked()) {
        let responses = sample.responses(lobes);
        for (channel, radiance) in sample.radiance.into_iter().enumerate() {
            let model: f64 = responses.iter().zip(coefficients).map(|(response, rho)| response * rho[channel]).sum();
            let terms = [(model - radiance).powi(2), radiance.powi(2), model - radiance, radiance];
            sums.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
        }
    }
    sums
}
