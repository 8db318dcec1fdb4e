use overpaint::{data::Map, gpu::Gpu, model::Boundary, reference, stage};

use crate::support::{hold, random::Random, worst_difference};

crate::suite! { gpu: agrees_with_its_twin; }

fn agrees_with_its_twin(gpu: &Gpu) {
    let stage = stage::Normals::new(gpu).expect("builds");
    // Both sides of a workgroup, a single texel, and one row past 65,535 workgroups of 64.
    for (width, height) in [(1, 1), (63, 1), (64, 1), (65, 1), (1, 65), (50, 100), (64 * 257, 256)] {
        for boundary in [Boundary::Periodic, Boundary::Mirror] {
            let mut random = Random::new(7);
            let heights = Map::from_fn(width, height, |_, _| random.between(-3.0, 3.0) as f32);
            let mut recorder = gpu.recorder();
            let buffer = gpu.upload("heights", heights.values()).expect("fits");
            let normals = stage.record(&mut recorder, &buffer, [width as u32, height as u32], boundary).expect("records");
            gpu.submit(recorder).wait(gpu).expect("runs");
            let found = normals.read(gpu).expect("reads");
            let expected = reference::normals(&heights.map(|&z| f64::from(z)), boundary);
            let found = found.iter().flat_map(|n| n.map(f64::from));
            let expected = expected.values().iter().flat_map(|n| [n[0], n[1], n[2], 0.0]);
            // Differences of f32 and one normalisation: a few units in the last place of 1 (6e-8 each).
            hold("normals: components", worst_difference(found, expected), 4e-7);
        }
    }
}
