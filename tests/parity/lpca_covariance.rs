use overpaint::{gpu::Gpu, reference, stage};

use crate::support::{Worst, hold, random::Random};

crate::suite! { gpu: agrees_with_its_twin; }

fn agrees_with_its_twin(gpu: &Gpu) {
    let stage = stage::LpcaCovariance::new(gpu).expect("builds");
    // Members are summed by 64; 72 + 8 rows are more blocks than a workgroup has threads.
    for (texels, rank, clusters) in [(1, 16, 1), (63, 16, 1), (64, 32, 3), (65, 16, 1), (130, 48, 2), (5000, 72, 3)] {
        let mut random = Random::new(54);
        let coordinates: Vec<f32> = (0..texels * rank).map(|_| random.between(-1.0, 1.0) as f32).collect();
        let about: Vec<(Vec<f64>, Vec<Vec<f64>>)> =
            (0..clusters).map(|_| ((0..rank).map(|_| f64::from(random.between(-0.1, 0.1) as f32)).collect(), Vec::new())).collect();
        // The last cluster has no members, if there are several.
        let cluster_of: Vec<u32> = (0..texels).map(|_| random.below(clusters.max(2) - 1) as u32).collect();
        let members = stage::Members::new(&cluster_of, clusters);
        let uploaded = gpu.upload("coordinates", coordinates.as_chunks().0).expect("fits");
        let on_gpu = stage::Subspaces::upload(gpu, &about, rank, 1).expect("fits");
        let mut recorder = gpu.recorder();
        let found = stage.record(&mut recorder, &uploaded, &on_gpu, &members.upload(gpu).expect("fits")).expect("records");
        gpu.submit(recorder).wait(gpu).expect("runs");
        let found = found.read(gpu).expect("reads");
        let found = found.as_flattened();
        let side = rank + 8;
        assert_eq!(found.len(), clusters * side * side);
        let points: Vec<Vec<f64>> = coordinates.chunks_exact(rank).map(|own| own.iter().map(|&value| f64::from(value)).collect()).collect();
        let mut errors = Vec::new();
        for (cluster, ((m, _), [start, end])) in about.iter().zip(&members.ranges).enumerate() {
            let own: Vec<&[f64]> = members.texels[*start as usize..*end as usize].iter().map(|&texel| points[texel as usize].as_slice()).collect();
            let number = own.len() as f64;
            let product = |row: usize, column: usize| f64::from(found[(cluster * side + row) * side + column]);
            assert_eq!(product(rank, rank), number, "members of cluster {cluster}");
            if own.is_empty() {
                assert!((0..rank).all(|row| product(row, rank) == 0.0 && product(0, row) == 0.0), "sums over nobody");
                continue;
            }
            let (mean, covariance) = reference::lpca_covariance(&own);
            let shift: Vec<f64> = mean.iter().zip(m).map(|(mean, m)| mean - m).collect();
            for row in 0..rank {
                errors.push((product(row, rank) / number - shift[row]).abs());
                for column in row..rank {
                    errors.push((product(row, column) / number - covariance[row][column] - shift[row] * shift[column]).abs());
                }
            }
        }
        // Sums by 64 and of those, terms of about 1/3, rounded to 6e-8 of the sum each.
        hold("lpca_covariance: sums over the number of members", errors.into_iter().worst(), 2e-6);
    }
}
