//! Known lobes, seen under a measured set's directions, come back through noise; texels that no lobe describes have defined results,
//! and the bounds that are stated hold for any data.

use glam::{DMat4, DVec4};
use half::f16;
use overpaint::{
    data::{FitStatus, Grid, OCTET, Samples},
    gpu::Gpu,
    model::{FitSettings, MIN_LOBE_SAMPLES, SpecularScale, lafortune},
    reference,
};

use super::{
    lafortune_fit::fit,
    masked::{Recovered, assert_finite, recover, recover_from_reflectance},
};
use crate::support::{hold, random::Random, tile};

crate::suite! {
    gpu: known_lobes_come_back_through_noise, so_do_their_parameters, the_narrowest_lobes_come_back, colours_come_back_through_all_stages,
        a_constant_reflectance_has_no_lobe, a_diffuse_texel_has_no_highlight, degenerate_texels_are_defined, bounds_hold_for_any_data,
        few_samples_get_no_false_lobe;
}

/// Lobes of every kind that the model has, (C_x, C_y, C_z, n).
const LOBES: [(&str, [f64; 4]); 13] = [
    ("mirror, n = 1", [-0.7, -0.7, 0.7, 1.0]),
    ("mirror, n = 3", [-0.9, -0.9, 0.9, 3.0]),
    ("mirror, n = 20", [-1.0, -1.0, 1.0, 20.0]),
    ("mirror, n = 100", [-1.02, -1.02, 1.02, 100.0]),
    ("retro, n = 2", [0.8, 0.8, 0.8, 2.0]),
    ("retro, n = 20", [0.95, 0.95, 0.95, 20.0]),
    ("retro, n = 60", [1.0, 1.0, 1.0, 60.0]),
    ("anisotropic, n = 10", [-1.05, -0.6, 1.0, 10.0]),
    ("anisotropic, n = 50", [-0.7, -1.0, 0.98, 50.0]),
    ("off-specular, n = 12", [-1.0, -1.0, 0.5, 12.0]),
    ("off-specular, n = 40", [-1.1, -1.1, 0.9, 40.0]),
    ("C_x > 0 > C_y, n = 8", [0.9, -0.9, 0.8, 8.0]),
    ("C_y > 0 > C_x, n = 30", [-0.95, 0.7, 0.9, 30.0]),
];

/// All pairs of Bonn's 81 directions.
fn ubo81() -> Samples {
    let directions = "ubo81".parse::<Grid>().expect("is a grid").directions();
    Samples::new(directions.iter().flat_map(|&view| directions.iter().map(move |&light| (view, light))).collect())
}

/// A lobe's value at each sample.
fn values(lobe: [f64; 4], samples: &Samples) -> Vec<f64> {
    samples.products().map(|product| lafortune(lobe, product)).collect()
}

fn squares(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum()
}

/// Relative RMS difference of a fitted lobe and the true values.
fn error(lobe: [f32; 4], truth: &[f64], samples: &Samples) -> f64 {
    let difference: Vec<f64> = values(lobe.map(f64::from), samples).iter().zip(truth).map(|(found, truth)| found - truth).collect();
    (squares(&difference) / squares(truth)).sqrt()
}

/// Normally distributed (Box, Muller 1958).
fn normal(random: &mut Random) -> f64 {
    (-2.0 * (1.0 - random.unit()).ln()).sqrt() * (std::f64::consts::TAU * random.unit()).cos()
}

/// Mean of max(value + sigma x, 0) for normal x, by the trapezoidal rule.
fn rectified(value: f64, sigma: f64) -> f64 {
    let nodes = (-24..=24).map(|index| f64::from(index) / 4.0);
    nodes.map(|x| 0.25 * (-0.5 * x * x).exp() * (value + sigma * x).max(0.0)).sum::<f64>() / std::f64::consts::TAU.sqrt()
}

/// The space that a lobe's gradient spans: to first order a least-squares fit is off by the projection of the data's errors on it (Seber,
/// Wild 1989, section 2.1).
struct Tangent {
    gradients: Vec<DVec4>,
    inverse: DMat4,
}

impl Tangent {
    fn new(lobe: [f64; 4], samples: &Samples) -> Self {
        let gradients: Vec<DVec4> = samples.products().map(|product| reference::lafortune_gradient(lobe, product).into()).collect();
        let gram = gradients.iter().fold(DMat4::ZERO, |sum, g| sum + DMat4::from_cols(*g * g.x, *g * g.y, *g * g.z, *g * g.w));
        Self { gradients, inverse: gram.inverse() }
    }

    /// Squared norm of the projection of `errors`.
    fn systematic(&self, errors: &[f64]) -> f64 {
        let along = self.gradients.iter().zip(errors).fold(DVec4::ZERO, |sum, (g, error)| sum + *g * *error);
        along.dot(self.inverse * along)
    }

    /// Expected squared norm of the projection of independent errors of standard deviations `sigmas`: for equal ones 4 sigma^2, the
    /// bound of Cramér and Rao for four parameters.
    fn random(&self, sigmas: &[f64]) -> f64 {
        self.gradients.iter().zip(sigmas).map(|(g, sigma)| g.dot(self.inverse * *g) * sigma * sigma).sum()
    }
}

const LEVELS: [f64; 5] = [0.0, 0.01, 0.03, 0.1, 0.3];

/// Standard deviations of noise at each sample: additive, `level` of the lobe's RMS, and multiplicative, `level` of each value.
fn noises(truth: &[f64], level: f64) -> [Vec<f64>; 2] {
    let rms = (squares(truth) / truth.len() as f64).sqrt();
    [vec![level * rms; truth.len()], truth.iter().map(|value| level * value).collect()]
}

/// Residuals `[octet][texel]` whose value is `value(sample, texel)`.
fn residuals(samples: &Samples, texels: usize, mut value: impl FnMut(usize, usize) -> f64) -> Vec<[f16; OCTET]> {
    let mut residual = vec![[f16::ZERO; OCTET]; samples.octets() * texels];
    for texel in 0..texels {
        for sample in 0..samples.len() {
            residual[sample / OCTET * texels + texel][sample % OCTET] = f16::from_f64(value(sample, texel));
        }
    }
    residual
}

/// The reprojected reflectance is as near to the true lobe's as the noise lets it be.
fn known_lobes_come_back_through_noise(gpu: &Gpu) {
    let samples = ubo81();
    let truths = LOBES.map(|(_, lobe)| values(lobe, &samples));
    let sigmas: Vec<Vec<f64>> = truths.iter().flat_map(|truth| LEVELS.iter().flat_map(|&level| noises(truth, level))).collect();
    let texels_a_lobe = sigmas.len() / LOBES.len();
    let mut random = Random::new(127);
    let residual = residuals(&samples, sigmas.len(), |sample, texel| {
        (truths[texel / texels_a_lobe][sample] + sigmas[texel][sample] * normal(&mut random)).max(0.0)
    });
    let lobes = fit(gpu, &residual, &samples, &FitSettings::default()).lobes.read(gpu).expect("reads");
    for (index, (name, lobe)) in LOBES.into_iter().enumerate() {
        let truth = &truths[index];
        let tangent = Tangent::new(lobe, &samples);
        for (place, texel) in (index * texels_a_lobe..(index + 1) * texels_a_lobe).enumerate() {
            let sigmas = &sigmas[texel];
            // Noise below zero is cut off, which lifts the mean where the lobe is dark.
            let lift: Vec<f64> = truth.iter().zip(sigmas).map(|(value, sigma)| rectified(*value, *sigma) - value).collect();
            // Thrice the expected length: of four equal parts one in 3e6 is longer, of a single one, as where few samples hold a narrow
            // lobe up, one in 400. Halves are rounded by 4.9e-4 of their value at most, and a projection is no longer than what it is of.
            let noise = 3.0 * tangent.random(sigmas).sqrt() + tangent.systematic(&lift).sqrt();
            let bound = noise / squares(truth).sqrt() + 5e-4;
            let what = format!("lobe recovery: {name:21} noise {:2.0} %", 100.0 * LEVELS[place / 2]);
            hold(&what, error(lobes[texel], truth, &samples), bound);
        }
    }
}

fn so_do_their_parameters(gpu: &Gpu) {
    let samples = ubo81();
    let truths = LOBES.map(|(_, lobe)| values(lobe, &samples));
    let mut random = Random::new(131);
    for level in [0.0, 0.01] {
        let residual = residuals(&samples, LOBES.len(), |sample, texel| truths[texel][sample] * (1.0 + level * normal(&mut random)));
        let lobes = fit(gpu, &residual, &samples, &FitSettings::default()).lobes.read(gpu).expect("reads");
        for (found, (name, truth)) in lobes.into_iter().zip(LOBES) {
            let found = found.map(f64::from);
            assert!((0..3).all(|axis| found[axis].signum() == truth[axis].signum()), "{name}: {found:?}");
            let size = truth[..3].iter().fold(0.0_f64, |size, c| size.max(c.abs()));
            let off = (0..3).map(|axis| (found[axis] - truth[axis]).abs() / size);
            // Thousands of samples tell a broad lobe's parameters, some tens a narrow one's: noise of 1 % leaves less than that.
            hold("lobe recovery: C, of its largest component", off.fold(0.0, f64::max), 0.01);
            hold("lobe recovery: n, relative", (found[3] / truth[3] - 1.0).abs(), 0.01);
        }
    }
}

/// As narrow as exponents may be: hardly more than the mirrored pairs, one a view, see such a lobe, and what they see must come back.
fn the_narrowest_lobes_come_back(gpu: &Gpu) {
    let samples = ubo81();
    let truths: Vec<Vec<f64>> =
        [150.0, 300.0, 600.0, 1000.0].iter().map(|&n| values([-1.0, -1.0, 1.0, n], &samples)).collect();
    let residual = residuals(&samples, truths.len(), |sample, texel| truths[texel][sample]);
    let fitted = fit(gpu, &residual, &samples, &FitSettings::default());
    for (lobe, truth) in fitted.lobes.read(gpu).expect("reads").into_iter().zip(&truths) {
        // Halves' rounding, and a thousandfold that of a base near 1 in single precision.
        hold("lobe recovery: narrowest lobes", error(lobe, truth, &samples), 1e-3);
    }
}

/// f = rho_d + rho_s lobe, from radiance.
fn colours_come_back_through_all_stages(gpu: &Gpu) {
    let samples = ubo81();
    let cosines: Vec<f64> = samples.light_cosines().collect();
    let truths = LOBES.map(|(_, lobe)| values(lobe, &samples));
    let (diffuse, specular) = ([0.1, 0.2, 0.4], [1.0, 0.5, 0.0]);
    let of = |channel: usize, lobe: f64| diffuse[channel] + specular[channel] * lobe;
    let radiance =
        tile::upload(gpu, LOBES.len(), samples.len(), |channel, sample, texel| cosines[sample] * of(channel, truths[texel][sample]));
    for (specular_scale, what, bound) in [
        // Radiance and reflectance are rounded to halves, each by 4.9e-4 at most.
        (SpecularScale::LeastSquares, "lobe recovery: all stages, least squares", 1e-3),
        // Here what is rounded is divided by lobes down to 0.01.
        (SpecularScale::MeanRatio, "lobe recovery: all stages, mean ratio", 1e-2),
    ] {
        let found = recover(gpu, &radiance, &samples, &FitSettings { specular_scale, ..FitSettings::default() });
        for (texel, truth) in truths.iter().enumerate() {
            let lobe = values(found.lobes[texel].map(f64::from), &samples);
            for channel in 0..3 {
                let (rho_d, rho_s) = (f64::from(found.diffuse[texel][channel]), f64::from(found.specular[texel][channel]));
                let off: Vec<f64> = lobe.iter().zip(truth).map(|(lobe, truth)| rho_d + rho_s * lobe - of(channel, *truth)).collect();
                let truth: Vec<f64> = truth.iter().map(|lobe| of(channel, *lobe)).collect();
                hold(what, (squares(&off) / squares(&truth)).sqrt(), bound);
            }
        }
    }
}

fn a_constant_reflectance_has_no_lobe(gpu: &Gpu) {
    let samples = ubo81();
    let levels = [6e-8, 1e-3, 0.3, 1.0, 65504.0];
    let reflectance = tile::upload(gpu, levels.len(), samples.len(), |_, _, texel| levels[texel]);
    let found = recover_from_reflectance(gpu, &reflectance, &samples, &FitSettings::default());
    for (texel, level) in levels.into_iter().enumerate() {
        let rho = f16::from_f64(level).to_f32();
        assert_eq!(found.diffuse[texel], [rho, rho, rho, 0.0]);
        assert_eq!((found.lobes[texel], found.specular[texel]), ([0.0, 0.0, 0.0, 1.0], [0.0; 4]));
        assert_eq!((found.objectives[texel], found.outcomes[texel]), ([0.0; 2], [FitStatus::NoSpecular as u32, 0]));
    }
}

/// What rounding leaves of a Lambertian texel's radiance above its diffuse part is no highlight.
fn a_diffuse_texel_has_no_highlight(gpu: &Gpu) {
    let samples = ubo81();
    let cosines: Vec<f64> = samples.light_cosines().collect();
    let mut random = Random::new(149);
    let albedos: Vec<f64> = (0..64).map(|_| random.between(0.01, 1.0)).collect();
    let radiance = tile::upload(gpu, albedos.len(), samples.len(), |_, sample, texel| albedos[texel] * cosines[sample]);
    let settings = FitSettings::default();
    let found = recover(gpu, &radiance, &samples, &settings);
    assert_sound(&found, &samples, &settings);
    for (texel, albedo) in albedos.into_iter().enumerate() {
        let highlight = values(found.lobes[texel].map(f64::from), &samples).into_iter().fold(0.0, f64::max);
        let highlight = highlight * f64::from(found.specular[texel][0]);
        // Two roundings to halves, of 4.9e-4 each, up or down.
        hold("lobe recovery: highlight of a diffuse texel", highlight / albedo, 2e-3);
        hold("lobe recovery: rho_d of a diffuse texel", (f64::from(found.diffuse[texel][0]) / albedo - 1.0).abs(), 1e-3);
    }
}

/// Finite results within the settings, and, from the lobe itself, none that is worse than no lobe.
fn assert_sound(found: &Recovered, samples: &Samples, settings: &FitSettings) {
    assert_finite(found, settings);
    let texels = found.lobes.len();
    for (texel, lobe) in found.lobes.iter().enumerate() {
        assert!(found.specular[texel].iter().chain(&found.diffuse[texel]).all(|rho| *rho >= 0.0), "texel {texel}");
        let s: Vec<f64> = (0..samples.len()).map(|sample| found.residual[sample * texels + texel]).collect();
        let with = reference::lafortune_objective(lobe.map(f64::from), &s, samples);
        let without = reference::lafortune_objective([0.0, 0.0, 0.0, 1.0], &s, samples);
        // C in single precision, half of 1.2e-7, moves the lobe by n times that, and the objective by twice as much again.
        let rounding = 1e-5 + 4e-7 * f64::from(lobe[3]);
        assert!(with <= without * (1.0 + rounding), "texel {texel}: {with:e} over {without:e} with {lobe:?}");
    }
}

/// A name, the radiance of a sample (negative: masked) by its number, its light's cosine and a number in 0..1 of its own, and how the
/// fit must end, if there is one way.
type Case = (&'static str, fn(usize, f64, f64) -> f64, Option<FitStatus>);

const LEAST: usize = MIN_LOBE_SAMPLES as usize;

const DEGENERATE: [Case; 19] = [
    ("black", |_, _, _| 0.0, Some(FitStatus::NoSpecular)),
    ("masked", |_, _, _| -1.0, Some(FitStatus::TooFewSamples)),
    ("one too few", |k, _, u| if k % 900 == 99 && k < 900 * (LEAST - 1) { u } else { -1.0 }, Some(FitStatus::TooFewSamples)),
    ("just enough", |k, _, u| if k % 900 == 99 && k < 900 * LEAST { u } else { -1.0 }, None),
    ("radiance 1", |_, _, _| 1.0, None),
    ("saturated", |_, _, _| 65504.0, Some(FitStatus::NoSpecular)),
    ("clipped at 1", |_, cosine, u| (20.0 * u * cosine).min(1.0), None),
    ("one above zero", |k, _, _| if k == 3333 { 1.0 } else { 0.0 }, None),
    ("one saturated above zero", |k, _, _| if k == 3333 { 65504.0 } else { 0.0 }, None),
    ("least half above zero", |k, _, _| if k == 3333 { 6e-8 } else { 0.0 }, None),
    ("lone outlier", |k, cosine, _| if k == 4444 { 65504.0 } else { 0.2 * cosine }, None),
    ("noise with an outlier", |k, cosine, u| if k == 77 { 65504.0 } else { u * cosine }, None),
    ("least halves", |_, _, u| 6e-8 * (8.0 * u).floor(), None),
    ("denormal halves", |_, _, u| 6e-5 * u, None),
    ("huge range", |_, _, u| 1e-4 * 6e8_f64.powf(u), None),
    ("black or saturated", |_, _, u| if u < 0.5 { 0.0 } else { 65504.0 }, None),
    ("one view", |k, _, u| if k / 81 == 50 { u } else { 0.0 }, None),
    ("one view of all, others masked", |k, _, u| if k / 81 == 50 { u } else { -1.0 }, None),
    ("one light, saturated", |k, _, _| if k % 81 == 60 { 65504.0 } else { 0.0 }, None),
];

fn degenerate_texels_are_defined(gpu: &Gpu) {
    let samples = ubo81();
    let cosines: Vec<f64> = samples.light_cosines().collect();
    let mut random = Random::new(137);
    let noise: Vec<f64> = (0..samples.len()).map(|_| random.unit()).collect();
    let value = |sample: usize, texel: usize| DEGENERATE[texel].1(sample, cosines[sample], noise[sample]);
    let radiance = tile::upload(gpu, DEGENERATE.len(), samples.len(), |_, sample, texel| value(sample, texel));
    for specular_scale in [SpecularScale::LeastSquares, SpecularScale::MeanRatio] {
        let settings = FitSettings { specular_scale, ..FitSettings::default() };
        let found = recover(gpu, &radiance, &samples, &settings);
        assert_sound(&found, &samples, &settings);
        for (texel, (name, _, expected)) in DEGENERATE.into_iter().enumerate() {
            let status = FitStatus::from_code(found.outcomes[texel][0]);
            assert!(status.is_some() && (expected.is_none() || status == expected), "{name}: {status:?}");
            let valid = (0..samples.len()).filter(|&sample| value(sample, texel) >= 0.0).count();
            assert_eq!(status == Some(FitStatus::TooFewSamples), valid < LEAST, "{name}");
            let nothing = found.lobes[texel] == [0.0, 0.0, 0.0, 1.0] && found.specular[texel] == [0.0; 4];
            assert_eq!(nothing, expected.is_some(), "{name}");
        }
    }
}

/// The exponent keeps to the settings, C is finite and the lobe no worse than none, whatever the data and the bounds.
fn bounds_hold_for_any_data(gpu: &Gpu) {
    let mut random = Random::new(139);
    let texels = 200;
    for exponents in [[0.5, 1000.0], [0.1, 1e4], [0.1, 0.1], [1.0, 1.0], [3.0, 3.5], [1e4, 1e4]] {
        let settings = FitSettings { exponents, ..FitSettings::default() };
        settings.checked().expect("may be set");
        for count in [9, 40, 257] {
            let samples = tile::directions(&mut random, count);
            let scales: Vec<f64> = (0..texels).map(|_| 10_f64.powf(random.between(-7.0, 4.8))).collect();
            // From even noise to a few bright samples.
            let radiance = tile::upload(gpu, texels, count, |_, _, texel| scales[texel] * random.unit().powi(1 + texel as i32 % 8));
            assert_sound(&recover(gpu, &radiance, &samples, &settings), &samples, &settings);
        }
    }
}

/// Descents through few samples, where the amplitude changes by orders of magnitude from step to step: an objective of nothing but
/// rounding must not win.
fn few_samples_get_no_false_lobe(gpu: &Gpu) {
    let (texels, count) = (20_000, 9);
    let mut random = Random::new(151);
    let samples = tile::directions(&mut random, count);
    let radiance = tile::upload(gpu, texels, count, |_, _, texel| random.unit().powi(1 + texel as i32 % 8));
    let settings = FitSettings::default();
    assert_sound(&recover(gpu, &radiance, &samples, &settings), &samples, &settings);
}
