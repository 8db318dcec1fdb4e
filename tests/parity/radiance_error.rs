use overpaint::{gpu::Gpu, reference, stage};

use crate::support::{
    Worst, hold,
    local::{Local, Uploaded},
    random::Random,
    tile,
};

crate::suite! { gpu: agrees_with_its_twin; }

/// The four sums `[texel]` for `planes`, ρ_d `[texel]` and then ρ_s `[lobe][texel]`.
pub fn radiance_error(gpu: &Gpu, local: &Local, radiance: &stage::Tile, planes: &[[f32; 4]]) -> Vec<[f64; 4]> {
    let stage = stage::RadianceError::new(gpu).expect("builds");
    let Uploaded { shading, directions, normals, lobes } = local.upload(gpu);
    let diffuse = gpu.upload("diffuse", &planes[..local.texels]).expect("fits");
    let specular = gpu.upload("specular", &planes[local.texels..]).expect("fits");
    let mut recorder = gpu.recorder();
    let errors =
        stage.record(&mut recorder, radiance, &shading, &directions, &normals, &diffuse, &specular, &lobes).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    errors.read(gpu).expect("reads").into_iter().map(|sums| sums.map(f64::from)).collect()
}

fn agrees_with_its_twin(gpu: &Gpu) {
    let ladder = [(1, 1, 1), (7, 63, 2), (8, 64, 3), (9, 65, 1), (2000, 40, 3), (3, 64 * 1000 + 1, 1)];
    for (samples, texels, lobes) in ladder {
        let mut random = Random::new(73);
        let local = Local::new(&mut random, texels, samples, 3, lobes);
        let radiance = tile::upload_masked(gpu, texels, samples, tile::a_quarter, |_, _, _| random.unit());
        let given = tile::unpack(&radiance.values.read(gpu).expect("reads"), texels);
        let planes: Vec<[f32; 4]> = (0..(1 + lobes) * texels).map(|_| [0; 4].map(|_| random.unit() as f32)).collect();
        let found = radiance_error(gpu, &local, &radiance, &planes);
        let mut errors = Vec::new();
        for (texel, found) in found.iter().enumerate() {
            let rho: Vec<[f64; 3]> =
                planes.chunks_exact(texels).map(|plane| [0, 1, 2].map(|channel| f64::from(plane[texel][channel]))).collect();
            let expected = reference::radiance_error(&local.samples_of(texel, &given), &rho, &local.lobes_of(texel));
            let [squares, of_radiance, error, radiance] = expected;
            // Differences are held against the sums of what they are differences of: model and radiance.
            let scales = [squares + of_radiance, of_radiance, error + 2.0 * radiance, radiance].map(|scale| scale.max(1e-3));
            errors.extend((0..4).map(|i| (found[i] - expected[i]).abs() / scales[i]));
        }
        // Each lobe's power is off by 1e-5 (log2 and exp2), and the model counts twice in a square; sums in blocks add 1e-6.
        hold("radiance_error: relative", errors.into_iter().worst(), 5e-5);
    }
}
