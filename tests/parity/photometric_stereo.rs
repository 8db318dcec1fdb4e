use half::f16;
use overpaint::{
    data::Direction,
    gpu::Gpu,
    model::StereoMethod::{self, LeastSquares, Robust},
    reference, stage,
};

use crate::support::{hold, random::Random, tile, worst_difference};

crate::suite! { gpu: agrees_with_its_twin, agrees_with_its_twin_under_masks_and_outliers; }

fn lights(random: &mut Random, count: usize) -> Vec<Direction> {
    (0..count).map(|index| Direction::from_degrees(random.between(10.0, 75.0), 130.0 * index as f64)).collect()
}

/// Worst difference of the components of normals, and of albedo over that of the brightest texel.
fn differences(gpu: &Gpu, lights: &[Direction], samples: &[Vec<[f16; 3]>], method: StereoMethod) -> (f64, f64) {
    let stage = stage::PhotometricStereo::new(gpu).expect("builds");
    let tile = tile::upload(gpu, samples.len(), lights.len(), |channel, sample, texel| samples[texel][sample][channel].to_f64());
    let mut recorder = gpu.recorder();
    let normals = stage.record(&mut recorder, &tile, lights, method).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    let found = normals.read(gpu).expect("reads");
    let expected: Vec<_> = samples
        .iter()
        .map(|samples| {
            let samples: Vec<_> = samples.iter().map(|rgb| rgb.map(f64::from)).collect();
            reference::photometric_stereo(&samples, lights, method)
        })
        .collect();
    let components = worst_difference(found.iter().flat_map(|n| [n[0], n[1], n[2]].map(f64::from)), expected.iter().flat_map(|(n, _)| *n));
    let brightest = expected.iter().fold(0.0, |most: f64, (_, albedo)| most.max(*albedo));
    let albedo = worst_difference(found.iter().map(|n| f64::from(n[3]) / brightest), expected.iter().map(|(_, albedo)| albedo / brightest));
    (components, albedo)
}

fn agrees_with_its_twin(gpu: &Gpu) {
    // Both sides of a workgroup and several of them; lights on both sides of an octet, and the two usual numbers.
    for (texels, count) in [(1, 3), (63, 7), (64, 8), (65, 9), (5000, 51), (100, 81)] {
        let mut random = Random::new(texels as u64);
        let lights = lights(&mut random, count);
        // Any positive radiance will do; half of it follows the light, so that no g is small against its terms.
        let samples: Vec<Vec<[f16; 3]>> = (0..texels)
            .map(|_| lights.iter().map(|light| [0; 3].map(|_| f16::from_f64(light.vector().z + random.between(0.0, 0.5)))).collect())
            .collect();
        // Sums of up to 81 terms of both signs, each rounded to half a unit in the last place (6e-8): a few units of the
        // largest partial sum, which is a small multiple of |g|.
        let (normals, albedo) = differences(gpu, &lights, &samples, LeastSquares);
        hold("photometric stereo, least squares: normals", normals, 1e-6);
        hold("photometric stereo, least squares: albedo", albedo, 1e-6);
        // Each of the reweighted solutions does so again, and hands on part of what it got from the one before.
        let (normals, albedo) = differences(gpu, &lights, &samples, Robust);
        hold("photometric stereo, robust: normals", normals, 1e-5);
        hold("photometric stereo, robust: albedo", albedo, 1e-5);
    }
}

/// A surface with shadows of its own, further shadows, highlights, and a tenth of the samples masked; every sixteenth texel has
/// nothing but masks, the one after it two samples.
fn agrees_with_its_twin_under_masks_and_outliers(gpu: &Gpu) {
    for (texels, count) in [(130, 23), (2000, 51), (100, 81)] {
        let mut random = Random::new(texels as u64);
        let lights = lights(&mut random, count);
        let samples: Vec<Vec<[f16; 3]>> = (0..texels)
            .map(|texel| {
                let normal = Direction::from_degrees(random.between(0.0, 50.0), random.between(0.0, 360.0)).vector();
                let mut sample = |index: usize, light: &Direction| {
                    let lit = 0.6 * light.vector().dot(normal).max(0.0) + random.between(0.0, 0.02);
                    let kept = match texel % 16 {
                        0 => 0,
                        1 => 2,
                        _ => count,
                    };
                    match random.unit() {
                        _ if index >= kept => [-1.0; 3],
                        draw if texel % 16 > 1 && draw < 0.1 => [-1.0; 3],
                        draw if draw < 0.2 => [0.0; 3],
                        draw if draw < 0.3 => [lit + 0.5; 3],
                        _ => [lit, 0.8 * lit, 0.5 * lit],
                    }
                    .map(f16::from_f64)
                };
                lights.iter().enumerate().map(|(index, light)| sample(index, light)).collect()
            })
            .collect();
        // As above: masks and outliers leave enough lights for that.
        let (normals, albedo) = differences(gpu, &lights, &samples, LeastSquares);
        hold("photometric stereo, least squares, masks: normals", normals, 1e-6);
        hold("photometric stereo, least squares, masks: albedo", albedo, 1e-6);
        let (normals, albedo) = differences(gpu, &lights, &samples, Robust);
        hold("photometric stereo, robust, masks: normals", normals, 1e-5);
        hold("photometric stereo, robust, masks: albedo", albedo, 1e-5);
    }
}
