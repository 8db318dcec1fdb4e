//! Twin of `gather`.

use half::f16;

/// The channels of one sample of a texel, −1 in all of them if any is NaN, infinite or negative.
#[must_use]
pub fn gather(channels: [f16; 3]) -> [f64; 3] {
    let values = channels.map(f64::from);
    if values.iter().all(|value| value.is_finite() && *value >= 0.0) { values.map(f64::abs) } else { [-1.0; 3] }
}
