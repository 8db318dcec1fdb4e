use half::f16;
use overpaint::{data::Direction, gpu::Gpu, reference, stage};

use crate::support::{hold, random::Random, tile, worst_difference};

crate::suite! { gpu: agrees_with_its_twin; }

fn agrees_with_its_twin(gpu: &Gpu) {
    let stage = stage::PhotometricStereo::new(gpu).expect("builds");
    // Both sides of a workgroup and several of them; lights on both sides of an octet, and the two usual numbers.
    for (texels, count) in [(1, 3), (63, 7), (64, 8), (65, 9), (5000, 51), (100, 81)] {
        let mut random = Random::new(texels as u64);
        let lights: Vec<_> = (0..count).map(|index| Direction::from_degrees(random.between(10.0, 75.0), 130.0 * index as f64)).collect();
        // Any positive radiance will do; half of it follows the light, so that no g is small against its terms.
        let samples: Vec<Vec<[f16; 3]>> = (0..texels)
            .map(|_| lights.iter().map(|light| [0; 3].map(|_| f16::from_f64(light.vector().z + random.between(0.0, 0.5)))).collect())
            .collect();
        let tile = tile::upload(gpu, texels, count, |channel, sample, texel| samples[texel][sample][channel].to_f64());
        let mut recorder = gpu.recorder();
        let normals = stage.record(&mut recorder, &tile, &lights).expect("records");
        gpu.submit(recorder).wait(gpu).expect("runs");
        let found = normals.read(gpu).expect("reads");
        let expected: Vec<_> = samples
            .iter()
            .map(|samples| {
                let samples: Vec<_> = samples.iter().map(|rgb| rgb.map(f64::from)).collect();
                reference::photometric_stereo(&samples, &lights)
            })
            .collect();
        // Sums of up to 81 terms of both signs, each rounded to half a unit in the last place (6e-8): a few units of the
        // largest partial sum, which is a small multiple of |g|.
        let components =
            worst_difference(found.iter().flat_map(|n| [n[0], n[1], n[2]].map(f64::from)), expected.iter().flat_map(|(normal, _)| *normal));
        hold("photometric stereo: normals", components, 1e-6);
        let albedo =
            worst_difference(found.iter().zip(&expected).map(|(n, (_, albedo))| f64::from(n[3]) / albedo), expected.iter().map(|_| 1.0));
        hold("photometric stereo: albedo, relative", albedo, 1e-6);
    }
}
