//! Twin of `specular_scale`.

use crate::{
    data::Samples,
    model::{FitSettings, SpecularScale, lafortune},
};

/// ρ_s of one channel from its residuals s = max(f − ρ_d, 0), one a sample and negative where masked, by the rule of
/// `settings` (thesis eq. 3.6).
#[must_use]
pub fn specular_scale(residuals: &[f64], samples: &Samples, lobe: [f64; 4], settings: &FitSettings) -> f64 {
    let pairs = samples.products().map(|product| lafortune(lobe, product)).zip(residuals).filter(|(_, s)| **s >= 0.0);
    match settings.specular_scale {
        SpecularScale::LeastSquares => {
            let (above, below) = pairs.fold((0.0, 0.0), |(above, below), (l, s)| (above + s * l, below + l * l));
            if below > settings.min_lobe.powi(2) { above / below } else { 0.0 }
        }
        SpecularScale::MeanRatio => {
            let ratios: Vec<f64> = pairs.filter(|(l, _)| *l > settings.min_lobe).map(|(l, s)| s / l).collect();
            #[expect(clippy::cast_precision_loss, reason = "samples are counted in thousands")]
            if ratios.is_empty() { 0.0 } else { ratios.iter().sum::<f64>() / ratios.len() as f64 }
        }
    }
}
