use overpaint::{
    data::Map,
    gpu::Gpu,
    model::{Layer, Paint},
    reference, stage,
};

use crate::support::{hold, random::Random, worst_difference};

crate::suite! { gpu: agrees_with_its_twin; }

fn agrees_with_its_twin(gpu: &Gpu) {
    let stage = stage::PaintRelief::new(gpu).expect("builds");
    let layer = Layer::new(Paint { name: "any".to_owned(), k: [0.0; 3], s: [1.0; 3] }, 1.0, 2.75);
    for (width, height) in [(1, 1), (63, 1), (64, 1), (65, 1), (50, 100), (64 * 257, 256)] {
        let mut random = Random::new(3);
        let ground = Map::from_fn(width, height, |_, _| random.between(-3.0, 3.0) as f32);
        let drawn = Map::from_fn(width, height, |_, _| random.unit() as f32);
        let ground_buffer = gpu.upload("ground", ground.values()).expect("fits");
        let drawn_buffer = gpu.upload("drawn", drawn.values()).expect("fits");
        let mut recorder = gpu.recorder();
        let heights = stage.record(&mut recorder, &ground_buffer, &drawn_buffer, &layer).expect("records");
        gpu.submit(recorder).wait(gpu).expect("runs");
        let found = heights.read(gpu).expect("reads");
        let expected = reference::paint_relief(&ground.map(|&z| f64::from(z)), &drawn.map(|&t| f64::from(t)), &layer);
        // A product below 2.75 and a sum below 5.75: half a unit in the last place each, 1.2e-7 + 2.4e-7.
        hold("paint_relief: heights", worst_difference(found.into_iter().map(f64::from), expected.values().iter().copied()), 4e-7);
    }
}
