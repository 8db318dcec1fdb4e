//! Spectral reflectance reduced to linear sRGB.
//!
//! A reflectance r(λ) that is known at some wavelengths is taken as linear between them and constant beyond the outermost ones. Its colour
//! is that under D65, because D65 is the white of sRGB: no adaptation to another white is needed.
//! XYZ = ∫ r S (x̄, ȳ, z̄) dλ with D65's power S and the colour matching functions of 1931, then the matrix of sRGB. At last each of R, G, B
//! is divided by what r = 1 gives, which differs from 1 by less than a hundredth (the colour matching functions are a fit), so that a
//! constant reflectance r is exactly (r, r, r).
//!
//! All of this is linear in r: each wavelength has a weight for each of R, G, B. Weights are negative where a pure colour lies outside sRGB.

use std::ops::RangeInclusive;

use super::color::linear_from_xyz;

/// Wavelengths of the integral, nm, in steps of 1 nm: those at which D65 is tabulated and light is seen.
const VISIBLE: RangeInclusive<u16> = 360..=780;

/// Relative power of D65 from 360 to 780 nm by 10 nm (ISO 11664-2:2007, table 1), 100 at 560 nm.
const D65: [f64; 43] = [
    46.6383, 52.0891, 49.9755, 54.6482, 82.7549, 91.4860, 93.4318, 86.6823, 104.865, 117.008, 117.812, 114.861, 115.923, 108.811, 109.354,
    107.802, 104.790, 107.689, 104.405, 104.046, 100.000, 96.3342, 95.7880, 88.6856, 90.0062, 89.5991, 87.6987, 83.2886, 83.6992, 80.0268,
    80.2146, 82.2778, 78.2842, 69.7213, 71.6091, 74.3490, 61.6040, 69.8856, 75.0870, 63.5927, 46.4182, 66.8054, 63.3828,
];

/// x̄, ȳ, z̄ of the CIE 1931 2° observer at a wavelength in nm: the multi-lobe fit of Wyman, Sloan, Shirley 2013, listing 1.
#[must_use]
pub fn color_matching(wavelength: f64) -> [f64; 3] {
    let lobe = |height: f64, center: f64, below: f64, above: f64| {
        let t = (wavelength - center) * if wavelength < center { below } else { above };
        height * (-0.5 * t * t).exp()
    };
    [
        lobe(0.362, 442.0, 0.0624, 0.0374) + lobe(1.056, 599.8, 0.0264, 0.0323) - lobe(0.065, 501.1, 0.0490, 0.0382),
        lobe(0.821, 568.8, 0.0213, 0.0247) + lobe(0.286, 530.9, 0.0613, 0.0322),
        lobe(1.217, 437.0, 0.0845, 0.0278) + lobe(0.681, 459.0, 0.0385, 0.0725),
    ]
}

/// Relative power of D65 at a wavelength in nm from 360 to 780, linear between tabulated ones; of the nearest of them beyond.
#[must_use]
pub fn d65(wavelength: f64) -> f64 {
    let at = ((wavelength - f64::from(*VISIBLE.start())) / 10.0).clamp(0.0, (D65.len() - 1) as f64);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an index of the table")]
    let below = (at.floor() as usize).min(D65.len() - 2);
    let t = at - below as f64;
    D65[below] * (1.0 - t) + D65[below + 1] * t
}

/// The weight of each wavelength's reflectance in linear R, G, B; see the module. The weights of a colour sum to 1. No wavelengths, no
/// weights.
///
/// # Panics
/// If `wavelengths`, in nm, do not ascend.
#[must_use]
pub fn rgb_weights(wavelengths: &[f64]) -> Vec<[f64; 3]> {
    assert!(wavelengths.windows(2).all(|pair| pair[0] < pair[1]), "wavelengths ascend");
    let mut weights = vec![[0.0; 3]; wavelengths.len()];
    for nm in VISIBLE.map(f64::from) {
        let color = linear_from_xyz(color_matching(nm).map(|matching| matching * d65(nm)));
        // The parts that the wavelengths on both sides have in r(λ).
        let above = wavelengths.partition_point(|&known| known < nm);
        let parts = match (above.checked_sub(1), wavelengths.get(above)) {
            (None, None) => continue,
            (None, Some(_)) => [(above, 1.0), (above, 0.0)],
            (Some(below), None) => [(below, 1.0), (below, 0.0)],
            (Some(below), Some(end)) => {
                let t = (nm - wavelengths[below]) / (end - wavelengths[below]);
                [(below, 1.0 - t), (above, t)]
            }
        };
        for (index, part) in parts {
            for (weight, color) in weights[index].iter_mut().zip(color) {
                *weight += part * color;
            }
        }
    }
    let white = weights.iter().fold([0.0; 3], |sum, weight| [0, 1, 2].map(|channel| sum[channel] + weight[channel]));
    weights.iter().map(|weight| [0, 1, 2].map(|channel| weight[channel] / white[channel])).collect()
}
