use overpaint::{gpu::Gpu, reference, stage};

use crate::support::{hold, random::Random, tile};

crate::suite! { gpu: agrees_with_its_twin, what_follows_the_last_sample_becomes_zero; }

fn agrees_with_its_twin(gpu: &Gpu) {
    for (samples, texels) in [(1, 1), (7, 63), (8, 64), (9, 65), (81, 500), (1, 64 * 20_000 + 1)] {
        let mut random = Random::new(17);
        let reflectance = tile::upload(gpu, texels, samples, |_, _, _| random.unit());
        let given = tile::unpack(&reflectance.values.read(gpu).expect("reads"), texels);
        let diffuse: Vec<[f32; 4]> = (0..texels).map(|_| [0, 1, 2, 3].map(|_| random.unit() as f32)).collect();
        let stage = stage::SpecularResidual::new(gpu).expect("builds");
        let mut recorder = gpu.recorder();
        let buffer = gpu.upload("diffuse", &diffuse).expect("fits");
        let residual = stage.record(&mut recorder, &reflectance, &buffer).expect("records");
        gpu.submit(recorder).wait(gpu).expect("runs");
        let found = tile::unpack(&residual.read(gpu).expect("reads"), texels);
        let plane = found.len();
        let mut worst = 0.0_f64;
        for (index, found) in found.iter().enumerate() {
            let texel = index % texels;
            let rho = [0, 1, 2].map(|channel| f64::from(diffuse[texel][channel]));
            let f = [0, 1, 2].map(|channel| given[channel * plane + index]);
            let expected = if index / texels < samples { reference::specular_residual(f, rho) } else { 0.0 };
            let error = (found - expected).abs();
            worst = if error.is_finite() { worst.max(error) } else { f64::NAN };
        }
        // One unit in the last place of a half below 1, 2^-11; the driver may truncate.
        hold("specular_residual", worst, 4.9e-4);
    }
}

fn what_follows_the_last_sample_becomes_zero(gpu: &Gpu) {
    for samples in [1_usize, 3, 5, 9] {
        let full = tile::upload(gpu, 5, samples.next_multiple_of(8), |_, _, _| 1.0);
        let reflectance = stage::Tile { samples, ..full };
        let stage = stage::SpecularResidual::new(gpu).expect("builds");
        let mut recorder = gpu.recorder();
        let diffuse = gpu.upload("diffuse", &[[0.25_f32; 4]; 5]).expect("fits");
        let residual = stage.record(&mut recorder, &reflectance, &diffuse).expect("records");
        gpu.submit(recorder).wait(gpu).expect("runs");
        for (index, found) in tile::unpack(&residual.read(gpu).expect("reads"), 5).into_iter().enumerate() {
            assert_eq!(found, if index / 5 < samples { 0.75 } else { 0.0 });
        }
    }
}
