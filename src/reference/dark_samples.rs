//! Twin of `dark_samples`.

use crate::model::FitSettings;

/// Whether a sample of reflectance `f` is masked or gets masked: its mean is below [`FitSettings::dark_fraction`] times that of the
/// texel's medians (thesis section 3.2.2, rough surfaces).
#[must_use]
pub fn dark_samples(f: [f64; 3], median: [f64; 3], settings: &FitSettings) -> bool {
    let mean = |values: [f64; 3]| values.iter().sum::<f64>() / 3.0;
    f.iter().any(|f| *f < 0.0) || mean(f) < settings.dark_fraction * mean(median)
}
