use overpaint::{
    gpu::Gpu,
    model::{FitSettings, SpecularScale, lafortune},
    stage,
};

use crate::support::{hold, random::Random, tile};

crate::suite! { gpu: a_scaled_lobe_gives_its_scale, no_lobe_gives_nothing; }

fn specular(gpu: &Gpu, lobe: [f32; 4], scales: [f64; 3], settings: &FitSettings) -> Vec<[f32; 4]> {
    let mut random = Random::new(61);
    let directions = tile::directions(&mut random, 500);
    let lobes: Vec<f64> = directions.products().map(|product| lafortune([-0.9, -0.9, 0.8, 6.0], product)).collect();
    let reflectance = tile::upload(gpu, 5, 500, |channel, sample, _| 0.25 + scales[channel] * lobes[sample]);
    let stage = stage::SpecularScale::new(gpu).expect("builds");
    let mut recorder = gpu.recorder();
    let diffuse = gpu.upload("diffuse", &[[0.25, 0.25, 0.25, 0.0]; 5]).expect("fits");
    let lobe = gpu.upload("lobes", &[lobe; 5]).expect("fits");
    let specular = stage.record(&mut recorder, &reflectance, &directions, &diffuse, &lobe, settings).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    specular.read(gpu).expect("reads")
}

/// f = ρ_d + ρ_s·lobe exactly: both rules must find ρ_s.
fn a_scaled_lobe_gives_its_scale(gpu: &Gpu) {
    let scales = [0.5, 1.0, 1.5];
    for rule in [SpecularScale::LeastSquares, SpecularScale::MeanRatio] {
        let settings = FitSettings { specular_scale: rule, min_lobe: 0.1, ..FitSettings::default() };
        for texel in specular(gpu, [-0.9, -0.9, 0.8, 6.0], scales, &settings) {
            for (found, expected) in texel.into_iter().zip(scales) {
                // The reflectance is rounded to a half, 5e-4 of a value near 1, over a lobe of at least 0.1.
                hold("specular_scale: known scale", (f64::from(found) - expected).abs(), 5e-3);
            }
        }
    }
}

fn no_lobe_gives_nothing(gpu: &Gpu) {
    for rule in [SpecularScale::LeastSquares, SpecularScale::MeanRatio] {
        let settings = FitSettings { specular_scale: rule, ..FitSettings::default() };
        assert_eq!(specular(gpu, [0.0, 0.0, 0.0, 1.0], [1.0; 3], &settings), [[0.0; 4]; 5]);
    }
}
