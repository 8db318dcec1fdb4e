use overpaint::{gpu::Gpu, reference, stage};

use crate::support::{hold, random::Random, tile};

crate::suite! { gpu: agrees_with_its_twin, a_fault_of_the_measurement_becomes_the_largest_half; }

fn agrees_with_its_twin(gpu: &Gpu) {
    for (samples, texels) in [(1, 1), (7, 63), (8, 64), (9, 65), (81, 500), (1, 64 * 21_846)] {
        let mut random = Random::new(5);
        let directions = tile::directions(&mut random, samples);
        let radiance = tile::upload(gpu, texels, samples, |_, _, _| random.unit());
        let given = tile::unpack(&radiance.values.read(gpu).expect("reads"), texels);
        let stage = stage::BrdfValues::new(gpu).expect("builds");
        let mut recorder = gpu.recorder();
        let reflectance = stage.record(&mut recorder, &radiance, &directions).expect("records");
        gpu.submit(recorder).wait(gpu).expect("runs");
        let found = tile::unpack(&reflectance.values.read(gpu).expect("reads"), texels);
        let filled = radiance.octets() * 8;
        let mut worst = 0.0_f64;
        for (index, (found, given)) in found.iter().zip(given).enumerate() {
            let sample = index / texels % filled;
            let expected = if sample < samples { reference::brdf_values(given, directions.directions()[sample].1) } else { 0.0 };
            let error = (found - expected).abs() / expected.max(1e-3);
            worst = if error.is_finite() { worst.max(error) } else { f64::NAN };
        }
        // One unit in the last place of a half: the driver may truncate.
        hold("brdf_values: relative", worst, 1.0 / 1024.0);
    }
}

fn a_fault_of_the_measurement_becomes_the_largest_half(gpu: &Gpu) {
    let mut random = Random::new(1);
    let directions = tile::directions(&mut random, 8);
    let radiance = tile::upload(gpu, 64, 8, |_, _, _| 65504.0);
    let stage = stage::BrdfValues::new(gpu).expect("builds");
    let mut recorder = gpu.recorder();
    let reflectance = stage.record(&mut recorder, &radiance, &directions).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    assert!(tile::unpack(&reflectance.values.read(gpu).expect("reads"), 64).iter().all(|value| *value == 65504.0));
}
