use overpaint::{
    data::Map,
    gpu::Gpu,
    model::{Boundary, FitSettings},
    reference, stage,
};

use crate::support::{fft_bound, hold, random::Random, worst_difference};

crate::suite! { gpu: agrees_with_its_twin; }

fn agrees_with_its_twin(gpu: &Gpu) {
    let stage = stage::FrankotChellappa::new(gpu).expect("builds");
    // One texel, one and two columns (whose only frequencies are ambiguous), both sides of a workgroup, even, odd and prime.
    for (width, height) in [(1, 1), (2, 2), (1, 9), (63, 1), (64, 1), (65, 3), (8, 6), (61, 67), (100, 50)] {
        let mut random = Random::new(height as u64);
        // Any directions, some of them facing away, so that some slopes are held; straight down and none at all, too.
        let mut normals = Map::from_fn(width, height, |_, _| {
            [random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-0.2, 1.0)].map(|component| component as f32)
        });
        if width > 2 {
            normals[(1, 0)] = [0.0, 0.0, -1.0];
            normals[(2, 0)] = [0.0; 3];
        }
        let uploaded: Vec<_> = normals.values().iter().map(|n| [n[0], n[1], n[2], 0.5]).collect();
        let buffer = gpu.upload("normals", &uploaded).expect("fits");
        for (boundary, detilt) in [(Boundary::Periodic, true), (Boundary::Mirror, true), (Boundary::Mirror, false)] {
            let settings = FitSettings { boundary, detilt, max_slope: 2.0, ..FitSettings::default() };
            let mut recorder = gpu.recorder();
            let heights = stage.record(&mut recorder, &buffer, [width as u32, height as u32], &settings).expect("records");
            gpu.submit(recorder).wait(gpu).expect("runs");
            let found = heights.read(gpu).expect("reads");
            let expected = reference::frankot_chellappa(&normals.map(|n| n.map(f64::from)), &settings);
            let largest = expected.values().iter().fold(1.0_f64, |largest, z| largest.max(z.abs()));
            let worst = worst_difference(found.iter().map(|&z| f64::from(z)), expected.values().iter().copied());
            // Transforms of the mirrored size, whose errors add in squares; the division gives a frequency's error and value
            // the same factor.
            let bound = fft_bound(2 * width) + fft_bound(2 * height);
            hold("frankot_chellappa: worst error over the largest height", worst / largest, bound);
        }
    }
}
