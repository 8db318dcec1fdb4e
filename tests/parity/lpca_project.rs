use overpaint::{data::OCTET, gpu::Gpu, reference, stage};

use crate::support::{Worst, hold, lines, random::Random, tile};

crate::suite! { gpu: agrees_with_its_twin; }

fn agrees_with_its_twin(gpu: &Gpu) {
    let stage = stage::LpcaProject::new(gpu).expect("builds");
    // Threads take texels a workgroup apart, and vectors by sixteens. Past 65,535 workgroups of 256 texels a tile no longer fits the binding that WebGPU
    // guarantees.
    let ladder = [(1, 1, 1), (7, 63, 3), (8, 64, 16), (9, 65, 17), (50, 255, 31), (50, 257, 33), (900, 256, 40), (1, 5000, 1)];
    for (samples, texels, vectors) in ladder {
        let mut random = Random::new(51);
        let radiance = tile::upload_masked(gpu, texels, samples, |sample, texel| sample > 0 && tile::a_quarter(sample, texel), |_, _, _| random.unit());
        let given = tile::unpack(&radiance.values.read(gpu).expect("reads"), texels);
        let values = 3 * radiance.octets() * OCTET;
        let mut vector = |low: f64| lines::vector(samples, radiance.octets(), |_, _| random.between(low, 1.0));
        let (centre, energy_weights) = (vector(0.0), vector(0.0));
        // Of about unit length.
        let length = (values as f64 / 3.0).sqrt();
        let vectors: Vec<Vec<f64>> = (0..vectors).map(|_| vector(-1.0).into_iter().map(|value| value / length).collect()).collect();
        let slices: Vec<&[f64]> = vectors.iter().map(Vec::as_slice).collect();
        let basis = stage::Basis::upload(gpu, &slices).expect("fits");
        let centre_lines = gpu.upload("centre", &stage::Line::of(&centre)).expect("fits");
        let weight_lines = gpu.upload("weights", &stage::Line::of(&energy_weights)).expect("fits");
        let mut recorder = gpu.recorder();
        let found = stage.record(&mut recorder, &radiance, &centre_lines, &weight_lines, &basis).expect("records");
        gpu.submit(recorder).wait(gpu).expect("runs");
        let (coordinates, energies) = (found.coordinates.read(gpu).expect("reads"), found.energies.read(gpu).expect("reads"));
        assert_eq!((coordinates.len(), energies.len()), (texels * basis.rank() / 4, texels));
        let (mut of_coordinates, mut of_energies) = (Vec::new(), Vec::new());
        let every = (texels / 5000).max(1);
        for texel in (0..texels).step_by(every).chain([texels - 1]) {
            let own = lines::texel(&given, texels, texel);
            let (expected, energy) = reference::lpca_project(&own, &centre, &energy_weights, &vectors);
            let found = coordinates[texel * basis.rank() / 4..][..basis.rank() / 4].as_flattened();
            // Past the last vector there is nothing.
            let expected = expected.into_iter().chain(std::iter::repeat(0.0));
            let length = reference::lpca_project(&own, &centre, &vec![1.0; values], &[]).1.sqrt().max(1e-3);
            of_coordinates.extend(found.iter().zip(expected).map(|(&found, expected)| (f64::from(found) - expected).abs() / length));
            of_energies.push((f64::from(energies[texel]) - energy).abs() / energy.max(1e-6));
        }
        // A basis vector's values are rounded to halves, 2^-12 of each, independently: products are off by 2^-12 / sqrt(3) of the product of lengths over
        // the root of the number of values, 3 at least.
        hold("lpca_project: coordinates over the texel's length", of_coordinates.into_iter().worst(), 2.0 / 4096.0);
        // Sums of up to 2700 squares in order, half a unit in the last place each.
        hold("lpca_project: energy, relative", of_energies.into_iter().worst(), 2e-5);
    }
}
