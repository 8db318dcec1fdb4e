use std::f64::consts::{FRAC_PI_2, PI};

use overpaint::{data::Map, gpu::Gpu, model::Placement, reference, stage};

use crate::support::{hold, random::Random, worst_difference};

crate::suite! { gpu: agrees_with_its_twin; }

fn agrees_with_its_twin(gpu: &Gpu) {
    let stage = stage::PatternImage::new(gpu).expect("builds");
    let placements = [
        Placement::default(),
        Placement { offset: [-0.3, 0.45], rotation: 0.7, ..Placement::default() },
        Placement { tiling: [3, 2], offset: [7.25, -3.5], rotation: -2.0, size: 0.3 },
        Placement { size: 2.5, rotation: 1.0, ..Placement::default() },
        Placement { offset: [0.1, 0.2], rotation: FRAC_PI_2, ..Placement::default() },
        Placement { tiling: [2, 2], rotation: -PI, ..Placement::default() },
    ];
    // Images of one pixel, magnified, of the plane's shape, and reduced once, twice and along one axis alone.
    for [width, height] in [[1, 1], [7, 5], [90, 60], [60, 90], [700, 450], [3000, 1], [1300, 1300]] {
        let mut random = Random::new(3);
        let image = Map::from_fn(width, height, |_, _| random.unit() as f32);
        let twin = image.map(|&value| f64::from(value));
        for placement in placements {
            for size in [[1, 1], [9, 7], [65, 1], [90, 60]] {
                let [columns, rows] = size;
                let drawn = gpu.fresh("drawn", columns as usize * rows as usize).expect("fits");
                let mut recorder = gpu.recorder();
                stage.record(&mut recorder, &image, placement, size, &drawn, 0).expect("records");
                gpu.submit(recorder).wait(gpu).expect("runs");
                let found: Vec<f32> = drawn.read(gpu).expect("reads");
                let expected = reference::pattern_image(&twin, placement, columns, rows);
                let worst = worst_difference(found.into_iter().map(f64::from), expected.values().iter().copied());
                // Places in the image are exact to 6e-8 of its largest coordinate, a few hundred pixels after reduction; weights change
                // by as much, neighbouring pixels by up to 1.
                hold("pattern_image: drawn thickness", worst, 5e-5);
            }
        }
    }
}
