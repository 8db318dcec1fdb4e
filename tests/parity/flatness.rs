use overpaint::{gpu::Gpu, model::Boundary, reference, stage::Flatness};

use crate::support::{
    hold,
    surface::{bumpy, upload},
    worst_difference,
};

crate::suite! { gpu: agrees_with_its_twin; }

fn agrees_with_its_twin(gpu: &Gpu) {
    for (width, height) in [(1, 1), (7, 9), (64, 1), (65, 3), (50, 100)] {
        for boundary in [Boundary::Periodic, Boundary::Mirror] {
            let surface = bumpy(width, height, boundary, 3);
            let mut recorder = gpu.recorder();
            let flatness = Flatness::new(gpu).expect("builds").record(&mut recorder, &upload(gpu, &surface).field).expect("records");
            gpu.submit(recorder).wait(gpu).expect("runs");
            let expected = reference::flatness(&surface.heights, &surface.normals, boundary);
            let found = flatness.read(gpu).expect("reads").into_iter().map(f64::from);
            // Laplacians of heights up to 4 cancel to 1e-6; slopes are below 3, of rounded normals.
            hold("flatness", worst_difference(found, expected.values().iter().copied()), 1e-5);
        }
    }
}
