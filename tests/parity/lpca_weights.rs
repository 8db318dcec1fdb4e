use half::f16;
use overpaint::{data::OCTET, gpu::Gpu, reference, stage};

use crate::support::{Worst, hold, lines, random::Random, tile};

crate::suite! { gpu: agrees_with_its_twin; }

fn rounded(vector: Vec<f64>) -> Vec<f64> {
    vector.into_iter().map(|value| f16::from_f64(value).to_f64()).collect()
}

fn agrees_with_its_twin(gpu: &Gpu) {
    let stage = stage::LpcaWeights::new(gpu).expect("builds");
    // Threads take four members of a cluster; lines are summed by 32.
    for (samples, texels, clusters, components) in [(1, 1, 1, 1_usize), (7, 63, 3, 2), (30, 64, 2, 4), (85, 260, 5, 5), (90, 1000, 2, 32)] {
        let mut random = Random::new(55);
        let radiance = tile::upload_masked(gpu, texels, samples, tile::a_quarter, |_, _, _| random.unit());
        let given = tile::unpack(&radiance.values.read(gpu).expect("reads"), texels);
        let octets = radiance.octets();
        let quads = components.div_ceil(4);
        let (mut terms, mut duals, mut scales, mut clusters_terms) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        for _ in 0..clusters {
            let mean = rounded(lines::vector(samples, octets, |_, _| random.unit()));
            // Orthogonal to half precision, so that e over its energy is nearly its own dual; what that leaves is the twin's to bear.
            let orthonormal = lines::orthonormal(&mut random, components.min(3 * samples), 3 * samples);
            let eigenvectors: Vec<Vec<f64>> = (0..components)
                .map(|index| {
                    let own = orthonormal.get(index);
                    rounded(lines::vector(samples, octets, |channel, sample| own.map_or(0.0, |own| own[channel * samples + sample])))
                })
                .collect();
            let slices = |vectors: &[Vec<f64>], width| stage::octets_by_line(&vectors.iter().map(Vec::as_slice).collect::<Vec<_>>(), 1.0, width);
            terms.extend(slices(&[vec![mean.clone()], eigenvectors.clone()].concat(), 1 + 4 * quads));
            duals.extend(slices(&eigenvectors, 4 * quads));
            scales.extend((0..4 * quads).map(|_| random.between(0.5, 2.0) as f32));
            clusters_terms.push((mean, eigenvectors));
        }
        let on_gpu = stage::ClusterTerms {
            terms: gpu.upload("terms", &terms).expect("fits"),
            duals: gpu.upload("duals", &duals).expect("fits"),
            scales: gpu.upload("scales", scales.as_chunks().0).expect("fits"),
            quads,
        };
        let cluster_of: Vec<u32> = (0..texels).map(|_| random.below(clusters) as u32).collect();
        let members = stage::Members::new(&cluster_of, clusters);
        let mut recorder = gpu.recorder();
        let found = stage.record(&mut recorder, &radiance, &members, &on_gpu).expect("records");
        gpu.submit(recorder).wait(gpu).expect("runs");
        let (weights, errors) = (found.weights.read(gpu).expect("reads"), found.errors.read(gpu).expect("reads"));
        let weights: &[f16] = bytemuck::cast_slice(&weights);
        assert_eq!((weights.len(), errors.len()), (members.texels.len() * 4 * quads, members.texels.len()));
        let values = 3 * octets * OCTET;
        let (mut of_weights, mut of_errors) = (Vec::new(), Vec::new());
        for (member, &texel) in members.texels.iter().enumerate() {
            let cluster = cluster_of[texel as usize] as usize;
            let (mean, eigenvectors) = &clusters_terms[cluster];
            let own = lines::texel(&given, texels, texel as usize);
            let (products, _) = reference::lpca_project(&own, mean, &vec![0.0; values], eigenvectors);
            let found: Vec<f64> = weights[member * 4 * quads..][..components].iter().map(|weight| weight.to_f64()).collect();
            let expected = products.iter().zip(&scales[cluster * 4 * quads..]).map(|(product, &scale)| product * f64::from(scale));
            of_weights.extend(found.iter().zip(expected).map(|(found, expected)| (found - expected).abs() / expected.abs().max(1e-2)));
            let expected = reference::lpca_weights(&own, mean, eigenvectors, &found);
            of_errors.extend((0..2).map(|sum| (f64::from(errors[member][sum]) - expected[sum]).abs() / expected[sum].max(1e-3)));
        }
        // Stored as halves, half a unit in the last place is 2^-11; a tie may go either way.
        hold("lpca_weights: weights", of_weights.into_iter().worst(), 1.05 / 2048.0);
        hold("lpca_weights: sums of squares, relative", of_errors.into_iter().worst(), 1e-5);
    }
}
