use overpaint::{gpu::Gpu, reference, stage};

use crate::support::{Worst, hold, lines, random::Random};

crate::suite! { gpu: agrees_with_its_twin, of_equally_near_ones_the_first; }

fn agrees_with_its_twin(gpu: &Gpu) {
    let stage = stage::LpcaAssign::new(gpu).expect("builds");
    // Past 65,535 workgroups of 256 texels the coordinates no longer fit the binding that WebGPU guarantees.
    let ladder = [(1, 16, 1, 1), (63, 16, 3, 4), (64, 32, 2, 5), (65, 16, 5, 8), (257, 48, 17, 9), (5000, 64, 4, 3)];
    for (texels, rank, clusters, components) in ladder {
        let mut random = Random::new(53);
        // As one by one: what is compared reads the same numbers.
        let coordinates: Vec<f32> = (0..texels * rank).map(|_| random.between(-1.0, 1.0) as f32).collect();
        let subspaces: Vec<(Vec<f64>, Vec<Vec<f64>>)> = (0..clusters)
            .map(|_| {
                let mean = (0..rank).map(|_| f64::from(random.between(-1.0, 1.0) as f32)).collect();
                (mean, lines::orthonormal(&mut random, components, rank))
            })
            .collect();
        let quads = components.div_ceil(4);
        let uploaded = gpu.upload("coordinates", coordinates.as_chunks().0).expect("fits");
        let on_gpu = stage::Subspaces::upload(gpu, &subspaces, rank, quads).expect("fits");
        let mut recorder = gpu.recorder();
        let found = stage.record(&mut recorder, &uploaded, &on_gpu).expect("records");
        gpu.submit(recorder).wait(gpu).expect("runs");
        let (cluster_of, residuals) = (found.cluster.read(gpu).expect("reads"), found.residuals.read(gpu).expect("reads"));
        let weights = found.weights.read(gpu).expect("reads");
        let (mut of_residuals, mut of_weights) = (Vec::new(), Vec::new());
        let every = (texels / 5000).max(1);
        for texel in (0..texels).step_by(every).chain([texels - 1]) {
            let own: Vec<f64> = coordinates[texel * rank..][..rank].iter().map(|&value| f64::from(value)).collect();
            let all: Vec<_> = subspaces.iter().map(|(mean, eigenvectors)| reference::lpca_assign(&own, mean, eigenvectors)).collect();
            let least = all.iter().map(|(distance, _)| *distance).fold(f64::INFINITY, f64::min);
            let (distance, expected) = &all[cluster_of[texel] as usize];
            // Near ties may go either way by rounding.
            of_residuals.push((distance - least) / rank as f64);
            of_residuals.push((f64::from(residuals[texel]) - distance).abs() / rank as f64);
            let found = weights[texel * quads..][..quads].as_flattened().iter().map(|&weight| f64::from(weight));
            let expected = expected.iter().copied().chain(std::iter::repeat(0.0));
            of_weights.extend(found.zip(expected).map(|(found, expected)| (found - expected).abs()));
        }
        // Differences of sums of up to 64 squares of up to 2, rounded to 6e-8 each.
        hold("lpca_assign: squared distance over the number of coordinates", of_residuals.into_iter().worst(), 2e-6);
        hold("lpca_assign: weights", of_weights.into_iter().worst(), 4e-6);
    }
}

fn of_equally_near_ones_the_first(gpu: &Gpu) {
    let stage = stage::LpcaAssign::new(gpu).expect("builds");
    let coordinates = gpu.upload("coordinates", &[[0.25_f32; 4]; 4]).expect("fits");
    let far = (vec![9.0; 16], Vec::new());
    let near = (vec![0.5; 16], Vec::new());
    let on_gpu = stage::Subspaces::upload(gpu, &[far, near.clone(), near], 16, 1).expect("fits");
    let mut recorder = gpu.recorder();
    let found = stage.record(&mut recorder, &coordinates, &on_gpu).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    assert_eq!(found.cluster.read(gpu).expect("reads"), [1]);
    assert_eq!(found.residuals.read(gpu).expect("reads"), [1.0]);
}
