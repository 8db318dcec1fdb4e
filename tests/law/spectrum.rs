use overpaint::model::{
    color::linear_from_xyz,
    spectrum::{color_matching, d65, rgb_weights},
};

use crate::support::{Worst, hold};

crate::suite! { plain: constant_reflectance_is_gray, white_is_d65, a_line_is_exact_however_sampled, fine_and_coarse_spectra_agree, pure_colours_are_where_they_belong; }

fn rgb(wavelengths: &[f64], reflectance: impl Fn(f64) -> f64) -> [f64; 3] {
    rgb_weights(wavelengths).iter().zip(wavelengths).fold([0.0; 3], |sum, (weight, &wavelength)| {
        [0, 1, 2].map(|channel| sum[channel] + weight[channel] * reflectance(wavelength))
    })
}

fn steps(first: f64, last: f64, step: f64) -> Vec<f64> {
    (0..).map(|index| first + step * f64::from(index)).take_while(|wavelength| *wavelength <= last).collect()
}

fn constant_reflectance_is_gray() {
    for wavelengths in [steps(400.0, 700.0, 10.0), steps(380.0, 730.0, 7.3), vec![450.0, 550.0, 650.0], vec![555.0], vec![900.0, 950.0]] {
        // A sum of some 400 terms in f64, of a size of a few.
        hold("spectrum: gray", rgb(&wavelengths, |_| 0.25).map(|value| (value - 0.25).abs()).into_iter().worst(), 1e-13);
    }
    assert!(rgb_weights(&[]).is_empty());
}

/// Chromaticity of D65 is 0.3127, 0.3290 (ISO 11664-2); the fit of the matching functions is within 0.0005 of it.
fn white_is_d65() {
    let xyz = (360..=780).map(f64::from).fold([0.0; 3], |sum, nm| [0, 1, 2].map(|index| sum[index] + d65(nm) * color_matching(nm)[index]));
    let sum: f64 = xyz.iter().sum();
    hold("spectrum: D65, x", (xyz[0] / sum - 0.312_72).abs(), 5e-4);
    hold("spectrum: D65, y", (xyz[1] / sum - 0.329_03).abs(), 5e-4);
    // The balance at the end has little to do.
    let white = linear_from_xyz(xyz.map(|value| value / xyz[1]));
    hold("spectrum: balance", white.map(|value| (value - 1.0).abs()).into_iter().worst(), 0.01);
}

/// A reflectance that is linear in the wavelength has the colour of its integral over every nm, however few wavelengths tell it.
fn a_line_is_exact_however_sampled() {
    let line = |nm: f64| 0.1 + (nm - 360.0) / 600.0;
    let product = |factor: &dyn Fn(f64) -> f64| {
        let matched = |nm: f64| linear_from_xyz(color_matching(nm).map(|matching| matching * d65(nm) * factor(nm)));
        (360..=780).map(f64::from).fold([0.0; 3], |sum, nm| [0, 1, 2].map(|index| sum[index] + matched(nm)[index]))
    };
    let (color, white) = (product(&line), product(&|_| 1.0));
    let expected = [0, 1, 2].map(|channel| color[channel] / white[channel]);
    for wavelengths in [vec![360.0, 780.0], vec![350.0, 444.4, 600.5, 790.0], steps(360.0, 780.0, 1.0), steps(355.0, 790.0, 7.25)] {
        let found = rgb(&wavelengths, line);
        // Sums of some 400 terms in f64.
        hold("spectrum: a line", found.iter().zip(expected).map(|(found, expected)| (found - expected).abs()).worst(), 1e-12);
    }
}

/// A smooth reflectance sampled every 10 nm has the colour that it has sampled every nm.
fn fine_and_coarse_spectra_agree() {
    let smooth = |nm: f64| 0.5 + 0.4 * ((nm - 400.0) / 60.0).sin();
    let (fine, coarse) = (rgb(&steps(360.0, 780.0, 1.0), smooth), rgb(&steps(360.0, 780.0, 10.0), smooth));
    // Linear between samples: h² / 8 max|r''| = 100 / 8 · 0.4 / 3600, times at most 2.3, the sum of a colour's absolute weights.
    hold("spectrum: 10 nm", fine.iter().zip(coarse).map(|(fine, coarse)| (fine - coarse).abs()).worst(), 3.2e-3);
}

fn pure_colours_are_where_they_belong() {
    let wavelengths = steps(380.0, 730.0, 10.0);
    let weights = rgb_weights(&wavelengths);
    let largest = |channel: usize| {
        let by_weight = |a: &usize, b: &usize| weights[*a][channel].total_cmp(&weights[*b][channel]);
        wavelengths[(0..weights.len()).max_by(by_weight).expect("has weights")]
    };
    assert!((590.0..=620.0).contains(&largest(0)) && (520.0..=560.0).contains(&largest(1)) && (430.0..=460.0).contains(&largest(2)));
    // A monochromatic green lies outside sRGB.
    assert!(weights[14][0] < 0.0, "{:?} at {}", weights[14], wavelengths[14]);
}
