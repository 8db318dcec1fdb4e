use overpaint::{gpu::Gpu, reference, stage};

use crate::support::{Worst, hold, random::Random, tile};

crate::suite! { gpu: agrees_with_its_twin; }

/// The residual `[sample][texel]`, with the filling after the last sample.
pub fn residual(gpu: &Gpu, reflectance: &stage::Tile, diffuse: &[[f32; 4]]) -> Vec<f64> {
    let stage = stage::SpecularResidual::new(gpu).expect("builds");
    let mut recorder = gpu.recorder();
    let diffuse = gpu.upload("diffuse", diffuse).expect("fits");
    let residual = stage.record(&mut recorder, reflectance, &diffuse).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    tile::unpack(&residual.read(gpu).expect("reads"), reflectance.texels)
}

fn agrees_with_its_twin(gpu: &Gpu) {
    for (samples, texels) in [(1, 1), (7, 63), (8, 64), (9, 65), (81, 500), (1, 64 * 20_000 + 1)] {
        let mut random = Random::new(17);
        let reflectance = tile::upload_masked(gpu, texels, samples, tile::a_quarter, |_, _, _| random.unit());
        let given = tile::unpack(&reflectance.values.read(gpu).expect("reads"), texels);
        let diffuse: Vec<[f32; 4]> = (0..texels).map(|_| [0, 1, 2, 3].map(|_| random.unit() as f32)).collect();
        let found = residual(gpu, &reflectance, &diffuse);
        let plane = found.len();
        assert_eq!(3 * plane, given.len());
        let errors = found.iter().enumerate().map(|(index, found)| {
            let texel = index % texels;
            let rho = [0, 1, 2].map(|channel| f64::from(diffuse[texel][channel]));
            let f = [0, 1, 2].map(|channel| given[channel * plane + index]);
            let expected = if index / texels < samples { reference::specular_residual(f, rho) } else { 0.0 };
            (found - expected).abs()
        });
        // One unit in the last place of a half below 1, 2^-11; the driver may truncate.
        hold("specular_residual", errors.worst(), 4.9e-4);
    }
}
