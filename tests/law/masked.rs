//! Masked samples through all stages of the reflectance, and texels of which little is left.

use overpaint::{
    data::{FitStatus, Samples},
    gpu::Gpu,
    model::{FitSettings, MIN_LOBE_SAMPLES, SpecularScale, lafortune},
    stage,
};

use crate::support::{Worst, hold, random::Random, tile};

crate::suite! {
    gpu: what_is_masked_does_not_matter, masking_is_leaving_out, texels_with_little_left_are_defined,
        hostile_texels_are_finite;
}

/// What the stages make of a tile of reflectance.
pub struct Recovered {
    pub reflectance: Vec<f64>,
    pub residual: Vec<f64>,
    pub diffuse: Vec<[f32; 4]>,
    pub specular: Vec<[f32; 4]>,
    pub lobes: Vec<[f32; 4]>,
    pub objectives: Vec<[f32; 2]>,
    pub outcomes: Vec<[u32; 2]>,
}

/// From a tile of radiance.
pub fn recover(gpu: &Gpu, radiance: &stage::Tile, samples: &Samples, settings: &FitSettings) -> Recovered {
    let mut recorder = gpu.recorder();
    let stage = stage::BrdfValues::new(gpu).expect("builds");
    let reflectance = stage.record(&mut recorder, radiance, samples).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    recover_from_reflectance(gpu, &reflectance, samples, settings)
}

pub fn recover_from_reflectance(gpu: &Gpu, reflectance: &stage::Tile, samples: &Samples, settings: &FitSettings) -> Recovered {
    let texels = reflectance.texels;
    let mut recorder = gpu.recorder();
    let stage = stage::Percentile::new(gpu).expect("builds");
    let diffuse = stage.record(&mut recorder, reflectance, settings.diffuse_quantile).expect("records");
    let stage = stage::SpecularResidual::new(gpu).expect("builds");
    let residual = stage.record(&mut recorder, reflectance, &diffuse).expect("records");
    let stage = stage::LafortuneFit::new(gpu).expect("builds");
    let fitted = stage.record(&mut recorder, &residual, samples, texels, settings).expect("records");
    let stage = stage::SpecularScale::new(gpu).expect("builds");
    let specular = stage.record(&mut recorder, reflectance, samples, &diffuse, &fitted.lobes, settings).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    Recovered {
        reflectance: tile::unpack(&reflectance.values.read(gpu).expect("reads"), texels),
        residual: tile::unpack(&residual.read(gpu).expect("reads"), texels),
        diffuse: diffuse.read(gpu).expect("reads"),
        specular: specular.read(gpu).expect("reads"),
        lobes: fitted.lobes.read(gpu).expect("reads"),
        objectives: fitted.objectives.read(gpu).expect("reads"),
        outcomes: fitted.outcomes.read(gpu).expect("reads"),
    }
}

impl Recovered {
    /// Everything that is kept, as bits.
    fn bits(&self) -> Vec<u32> {
        let floats = [self.diffuse.as_flattened(), self.specular.as_flattened(), self.lobes.as_flattened(), self.objectives.as_flattened()];
        floats.concat().into_iter().map(f32::to_bits).chain(self.outcomes.as_flattened().iter().copied()).collect()
    }
}

/// Both rules of the specular scale.
fn settings() -> [FitSettings; 2] {
    [SpecularScale::LeastSquares, SpecularScale::MeanRatio]
        .map(|specular_scale| FitSettings { specular_scale, max_iterations: 20, ..FitSettings::default() })
}

/// Radiance of a lobe over a diffuse part, with noise: `[channel][sample][texel]`.
fn glossy(random: &mut Random, samples: &Samples, texels: usize) -> Vec<f64> {
    let lobes: Vec<[f64; 4]> =
        (0..texels).map(|_| [-random.between(0.7, 1.0), -0.85, random.between(0.7, 1.0), random.between(1.5, 9.0)]).collect();
    let mut values = Vec::new();
    for channel in 0..3 {
        for (product, cosine) in samples.products().zip(samples.light_cosines()) {
            values.extend(lobes.iter().map(|lobe| {
                let f = 0.1 + 0.05 * channel as f64 + (1.0 - 0.2 * channel as f64) * lafortune(*lobe, product);
                cosine * f * random.between(0.9, 1.1)
            }));
        }
    }
    values
}

/// Any other negative values, also of the reflectance, give the same bits.
fn what_is_masked_does_not_matter(gpu: &Gpu) {
    let (texels, count) = (65, 203);
    let mut random = Random::new(101);
    let samples = tile::directions(&mut random, count);
    let values = glossy(&mut random, &samples, texels);
    for settings in settings() {
        let with = |patterns: &[f64]| {
            let mut random = Random::new(103);
            let tile = tile::upload(gpu, texels, count, |channel, sample, texel| {
                let pattern = patterns[random.below(patterns.len())];
                if tile::a_quarter(sample, texel) { pattern } else { values[(channel * count + sample) * texels + texel] }
            });
            [recover(gpu, &tile, &samples, &settings), recover_from_reflectance(gpu, &tile, &samples, &settings)]
        };
        let [plain, of_reflectance] = with(&[-1.0]);
        let [other, other_of_reflectance] = with(&[-65504.0, -0.25, -3.0, -1e-3]);
        assert!(plain.bits() == other.bits() && of_reflectance.bits() == other_of_reflectance.bits());
        assert!(plain.residual == other.residual && of_reflectance.residual == other_of_reflectance.residual);
        let plane = plain.residual.len();
        for (index, residual) in plain.residual.iter().enumerate() {
            let masked = index / texels < count && tile::a_quarter(index / texels, index % texels);
            assert_eq!(*residual == -1.0, masked);
            assert!((0..3).all(|channel| (plain.reflectance[channel * plane + index] == -1.0) == masked));
        }
    }
}

/// A tile without the samples that another masks gives the same, but for the rounding of sums.
fn masking_is_leaving_out(gpu: &Gpu) {
    let (texels, count) = (65, 203);
    let mut random = Random::new(107);
    let samples = tile::directions(&mut random, count);
    let values = glossy(&mut random, &samples, texels);
    let value = |channel: usize, sample: usize, texel: usize| values[(channel * count + sample) * texels + texel];
    let kept: Vec<usize> = (0..count).filter(|&sample| !tile::a_quarter(sample, 0)).collect();
    let fewer = Samples::new(kept.iter().map(|&sample| samples.directions()[sample]).collect());
    for settings in settings() {
        let masked = tile::upload_masked(gpu, texels, count, |sample, _| tile::a_quarter(sample, 0), value);
        let masked = recover(gpu, &masked, &samples, &settings);
        let left_out = tile::upload(gpu, texels, kept.len(), |channel, sample, texel| value(channel, kept[sample], texel));
        let left_out = recover(gpu, &left_out, &fewer, &settings);
        assert_eq!(masked.diffuse, left_out.diffuse);
        let relative = |a: &[f32], b: &[f32]| a.iter().zip(b).map(|(a, b)| f64::from((a - b).abs() / b.abs().max(1e-6))).worst();
        let objectives = relative(masked.objectives.as_flattened(), left_out.objectives.as_flattened());
        // Descents that are rounded otherwise stop elsewhere in the last 1e-6, of which a slow tail has some tens.
        hold("masked samples: objectives without them", objectives, 1e-4);
        // At its minimum the objective is flat: 1e-6 of it leaves the root of that to the lobe, and so to its scale.
        hold("masked samples: rho_s without them", relative(masked.specular.as_flattened(), left_out.specular.as_flattened()), 1e-3);
    }
}

/// A name, the radiance of each sample (negative: masked), and how the fit must end, if there is one way.
type Case = (&'static str, fn(usize) -> f64, Option<FitStatus>);

fn texels_with_little_left_are_defined(gpu: &Gpu) {
    const LEAST: usize = MIN_LOBE_SAMPLES as usize;
    fn first(valid: usize, sample: usize, value: f64) -> f64 {
        if sample * 5 % 81 < valid { value } else { -1.0 }
    }
    fn uneven(sample: usize) -> f64 {
        0.1 + (sample * 29 % 81) as f64 / 81.0
    }
    let cases: [Case; 13] = [
        ("all masked", |_| -1.0, Some(FitStatus::TooFewSamples)),
        ("one valid", |k| first(1, k, uneven(k)), Some(FitStatus::TooFewSamples)),
        ("one valid and black", |k| first(1, k, 0.0), Some(FitStatus::TooFewSamples)),
        ("one too few", |k| first(LEAST - 1, k, uneven(k)), Some(FitStatus::TooFewSamples)),
        ("just enough", |k| first(LEAST, k, uneven(k)), None),
        ("just enough and black", |k| first(LEAST, k, 0.0), Some(FitStatus::NoSpecular)),
        ("just enough and saturated", |k| first(LEAST, k, 65504.0), Some(FitStatus::NoSpecular)),
        ("all black", |_| 0.0, Some(FitStatus::NoSpecular)),
        ("constant", |_| 0.25, None),
        ("saturated", |_| 65504.0, Some(FitStatus::NoSpecular)),
        ("one saturated", |k| if k == 40 { 65504.0 } else { uneven(k) }, None),
        ("half saturated", |k| if k % 2 == 0 { 65504.0 } else { uneven(k) }, None),
        ("half saturated, half masked", |k| if k % 2 == 0 { 65504.0 } else { -1.0 }, Some(FitStatus::NoSpecular)),
    ];
    let samples = tile::directions(&mut Random::new(109), 81);
    let radiance = tile::upload(gpu, cases.len(), 81, |_, sample, texel| cases[texel].1(sample));
    for settings in settings() {
        let found = recover(gpu, &radiance, &samples, &settings);
        assert_finite(&found, &settings);
        for (texel, (name, value, expected)) in cases.into_iter().enumerate() {
            let status = FitStatus::from_code(found.outcomes[texel][0]);
            assert!(status.is_some() && (expected.is_none() || status == expected), "{name}: {status:?}");
            let valid = (0..81).filter(|&sample| value(sample) >= 0.0).count();
            assert_eq!(status == Some(FitStatus::TooFewSamples), valid < LEAST, "{name}");
            if matches!(status, Some(FitStatus::TooFewSamples | FitStatus::NoSpecular)) {
                assert_eq!((found.lobes[texel], found.specular[texel]), ([0.0, 0.0, 0.0, 1.0], [0.0; 4]), "{name}");
                assert_eq!(found.outcomes[texel][1], 0, "{name}: steps");
                let [without, with] = found.objectives[texel];
                assert_eq!(without, with, "{name}");
            }
            assert_eq!(found.diffuse[texel] == [0.0; 4], valid == 0 || name.ends_with("black"), "{name}");
        }
        assert_eq!(found.objectives[0], [0.0; 2]);
        // One sample is its own quantile.
        assert_eq!(found.objectives[1], [0.0; 2]);
    }
}

/// No value that is not finite, no exponent out of bounds, no lobe that is worse than none.
pub fn assert_finite(found: &Recovered, settings: &FitSettings) {
    let [least, greatest] = settings.exponents.map(|exponent| exponent as f32);
    for texel in 0..found.lobes.len() {
        let (lobe, [without, with]) = (found.lobes[texel], found.objectives[texel]);
        let all = [&found.diffuse[texel][..], &found.specular[texel], &lobe, &found.objectives[texel]].concat();
        assert!(all.iter().all(|value| value.is_finite()), "texel {texel}: {all:?}");
        assert!(lobe == [0.0, 0.0, 0.0, 1.0] || (least..=greatest).contains(&lobe[3]), "texel {texel}: {lobe:?}");
        // The two are summed in different orders.
        assert!(with <= without * 1.000_01, "texel {texel}: {with} over {without}");
    }
    assert!(found.reflectance.iter().chain(&found.residual).all(|value| (-1.0..=65504.0).contains(value)));
}

/// Few valid samples of any size, from the least half to the largest.
fn hostile_texels_are_finite(gpu: &Gpu) {
    let texels = 2000;
    let mut random = Random::new(113);
    for count in [9, 24, 81] {
        let samples = tile::directions(&mut random, count);
        let values: Vec<f64> = (0..texels * count)
            .map(|index| {
                let share = (index % texels) as f64 / texels as f64;
                let extremes = [0.0, 6e-8, 1e-4, 0.5, 1.0, 65504.0];
                if random.unit() < share * 0.9 { -1.0 } else { extremes[random.below(extremes.len())] }
            })
            .collect();
        let radiance = tile::upload(gpu, texels, count, |_, sample, texel| values[sample * texels + texel]);
        for settings in settings() {
            assert_finite(&recover(gpu, &radiance, &samples, &settings), &settings);
        }
    }
}
