use overpaint::{data::Samples, gpu::Gpu, reference, stage};

use crate::support::{Worst, hold, random::Random, tile};

crate::suite! { gpu: agrees_with_its_twin; }

/// The reflectance `[channel][sample][texel]`, with the filling after the last sample.
pub fn reflectance(gpu: &Gpu, radiance: &stage::Tile, directions: &Samples) -> Vec<f64> {
    let stage = stage::BrdfValues::new(gpu).expect("builds");
    let mut recorder = gpu.recorder();
    let reflectance = stage.record(&mut recorder, radiance, directions).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    tile::unpack(&reflectance.values.read(gpu).expect("reads"), radiance.texels)
}

fn agrees_with_its_twin(gpu: &Gpu) {
    for (samples, texels) in [(1, 1), (7, 63), (8, 64), (9, 65), (81, 500), (1, 64 * 21_846)] {
        let mut random = Random::new(5);
        let directions = tile::directions(&mut random, samples);
        let radiance = tile::upload_masked(gpu, texels, samples, tile::a_quarter, |_, _, _| random.unit());
        let given = tile::unpack(&radiance.values.read(gpu).expect("reads"), texels);
        let found = reflectance(gpu, &radiance, &directions);
        let filled = radiance.octets() * 8;
        assert_eq!(found.len(), given.len());
        let errors = found.into_iter().zip(given).enumerate().map(|(index, (found, given))| {
            let sample = index / texels % filled;
            let expected = if sample < samples { reference::brdf_values(given, directions.directions()[sample].1) } else { 0.0 };
            (found - expected).abs() / expected.abs().max(1e-3)
        });
        // One unit in the last place of a half: the driver may truncate.
        hold("brdf_values: relative", errors.worst(), 1.0 / 1024.0);
    }
}
