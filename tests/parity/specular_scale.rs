use overpaint::{
    gpu::Gpu,
    model::{FitSettings, SpecularScale},
    reference, stage,
};

use crate::support::{Worst, hold, random::Random, tile};

crate::suite! { gpu: agrees_with_its_twin; }

fn agrees_with_its_twin(gpu: &Gpu) {
    for rule in [SpecularScale::LeastSquares, SpecularScale::MeanRatio] {
        let settings = FitSettings { specular_scale: rule, ..FitSettings::default() };
        for (samples, texels) in [(1, 1), (7, 63), (8, 64), (9, 65), (6561, 3), (9, 64 * 1000 + 1)] {
            let mut random = Random::new(19);
            let directions = tile::directions(&mut random, samples);
            let reflectance = tile::upload_masked(gpu, texels, samples, tile::a_quarter, |_, _, _| random.unit());
            let given = tile::unpack(&reflectance.values.read(gpu).expect("reads"), texels);
            let diffuse: Vec<[f32; 4]> = (0..texels).map(|_| [0, 1, 2, 3].map(|_| random.between(0.0, 0.3) as f32)).collect();
            let lobe = |random: &mut Random| {
                let [x, y] = [0, 1].map(|_| random.between(-1.2, -0.2) as f32);
                [x, y, random.between(0.2, 1.2) as f32, random.between(1.0, 40.0) as f32]
            };
            let lobes: Vec<[f32; 4]> = (0..texels).map(|_| lobe(&mut random)).collect();
            let stage = stage::SpecularScale::new(gpu).expect("builds");
            let mut recorder = gpu.recorder();
            let diffuse_buffer = gpu.upload("diffuse", &diffuse).expect("fits");
            let lobes_buffer = gpu.upload("lobes", &lobes).expect("fits");
            let specular = stage.record(&mut recorder, &reflectance, &directions, &diffuse_buffer, &lobes_buffer, &settings).expect("records");
            gpu.submit(recorder).wait(gpu).expect("runs");
            let found = specular.read(gpu).expect("reads");
            let filled = reflectance.octets() * 8;
            let mut errors = Vec::new();
            for texel in 0..texels {
                assert_eq!(found[texel][3].to_bits(), 0);
                for channel in 0..3 {
                    let residuals: Vec<f64> = (0..samples)
                        .map(|sample| given[(channel * filled + sample) * texels + texel])
                        .map(|f| if f < 0.0 { f } else { (f - f64::from(diffuse[texel][channel])).max(0.0) })
                        .collect();
                    let expected = reference::specular_scale(&residuals, &directions, lobes[texel].map(f64::from), &settings);
                    errors.push((f64::from(found[texel][channel]) - expected).abs() / expected.abs().max(1e-3));
                }
            }
            // The lobe's power turns 1.3e-6 of the logarithm (WGSL's log2 and exp2) and of the base's rounding, times n <= 40, into
            // 1e-5 each, and a sample whose base all but cancels adds as much again.
            hold("specular_scale: relative", errors.into_iter().worst(), 1e-4);
        }
    }
}
