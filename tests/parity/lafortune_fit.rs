use half::f16;
use overpaint::{
    data::{FitStatus, OCTET, Samples},
    gpu::Gpu,
    model::{FitSettings, MIN_LOBE_SAMPLES, lafortune},
    reference, stage,
};

use crate::support::{Worst, hold, random::Random, tile};

crate::suite! { gpu: objective_is_as_low_as_its_twins, so_it_is_between_tight_bounds, so_it_is_with_masked_samples; }

/// Noisy lobes: s = (C p)^n plus noise, never negative. Broad enough that a few dozen random samples see them.
pub fn noisy_lobes(random: &mut Random, samples: &Samples, texels: usize, noise: f64) -> Vec<[f16; OCTET]> {
    let octets = samples.octets();
    let mut residual = vec![[f16::ZERO; OCTET]; octets * texels];
    for texel in 0..texels {
        let scale = random.between(0.6, 1.1);
        let lobe = [-scale, -scale * random.between(0.8, 1.2), scale * random.between(0.6, 1.2), random.between(1.2, 8.0)];
        for (sample, product) in samples.products().enumerate() {
            let value = (lafortune(lobe, product) + noise * random.between(-1.0, 1.0)).max(0.0);
            residual[sample / OCTET * texels + texel][sample % OCTET] = f16::from_f64(value);
        }
    }
    residual
}

fn objective_is_as_low_as_its_twins(gpu: &Gpu) {
    for (samples, texels) in [(40, 1), (63, 63), (257, 64), (512, 5), (513, 5), (600, 65), (2601, 5), (257, 257)] {
        compare(gpu, samples, texels, &FitSettings::default(), |_, _| false);
    }
}

/// Most of these lobes want an exponent outside, so either bound is active in many texels.
fn so_it_is_between_tight_bounds(gpu: &Gpu) {
    compare(gpu, 257, 64, &FitSettings { exponents: [2.0, 4.0], ..FitSettings::default() }, |_, _| false);
}

/// A quarter of them, and, by texels, from none to all.
fn so_it_is_with_masked_samples(gpu: &Gpu) {
    compare(gpu, 257, 64, &FitSettings::default(), tile::a_quarter);
    compare(gpu, 600, 65, &FitSettings::default(), |sample, texel| (sample * 37) % 64 < texel);
}

fn compare(gpu: &Gpu, samples: usize, texels: usize, settings: &FitSettings, masked: impl Fn(usize, usize) -> bool) {
    let mut random = Random::new(23);
    let directions = tile::directions(&mut random, samples);
    let mut residual = noisy_lobes(&mut random, &directions, texels, 0.05);
    for (sample, texel) in (0..samples).flat_map(|sample| (0..texels).map(move |texel| (sample, texel))) {
        if masked(sample, texel) {
            residual[sample / OCTET * texels + texel][sample % OCTET] = f16::NEG_ONE;
        }
    }
    let given = tile::unpack(&residual, texels);
    let stage = stage::LafortuneFit::new(gpu).expect("builds");
    let mut recorder = gpu.recorder();
    let buffer = gpu.upload("residual", &residual).expect("fits");
    let fitted = stage.record(&mut recorder, &buffer, &directions, texels, settings).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    let (lobes, objectives) = (fitted.lobes.read(gpu).expect("reads"), fitted.objectives.read(gpu).expect("reads"));
    let outcomes = fitted.outcomes.read(gpu).expect("reads");
    let (mut excess, mut misreported) = (Vec::new(), Vec::new());
    for texel in 0..texels {
        let s: Vec<f64> = (0..samples).map(|sample| given[sample * texels + texel]).collect();
        let twin = -stage::STARTS
            .iter()
            .map(|[x, y, z, n]| [*x, *y, *z, n.clamp(settings.exponents[0] as f32, settings.exponents[1] as f32)].map(f64::from))
            .map(|start| -reference::lafortune_fit(start, &s, &directions, settings).objective)
            .worst();
        let found = reference::lafortune_objective(lobes[texel].map(f64::from), &s, &directions);
        let valid: Vec<f64> = s.iter().copied().filter(|s| *s >= 0.0).collect();
        if valid.len() < MIN_LOBE_SAMPLES as usize {
            assert_eq!(FitStatus::from_code(outcomes[texel][0]), Some(FitStatus::TooFewSamples));
            misreported.push((f64::from(objectives[texel][1]) - twin).abs());
            continue;
        }
        let energy = valid.iter().map(|s| s * s).sum::<f64>() / valid.len() as f64;
        excess.push(found / twin - 1.0);
        misreported.push((f64::from(objectives[texel][1]) / found - 1.0).abs());
        misreported.push((f64::from(objectives[texel][0]) / energy - 1.0).abs());
        assert!(FitStatus::from_code(outcomes[texel][0]).is_some(), "status {} of texel {texel}", outcomes[texel][0]);
    }
    // The descent stops when a step gains less than 1e-6; what is left of a slow tail is some tens of such steps.
    hold("lafortune_fit: objective over the twin's", excess.into_iter().worst(), 1e-4);
    // Single precision's sum of thousands of squares, and the lobe's rounding to (C, n).
    hold("lafortune_fit: reported objectives", misreported.into_iter().worst(), 1e-4);
}
