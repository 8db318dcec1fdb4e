use overpaint::{gpu::Gpu, reference};

use super::kubelka_munk::{expected_values, random_drawing, random_ground, random_layer, texels};
use crate::support::{
    hold,
    paint::blend,
    random::Random,
    worst_difference,
};

crate::suite! { gpu: agrees_with_its_twin; }

fn agrees_with_its_twin(gpu: &Gpu) {
    let mut random = Random::new(12);
    for (width, height, count) in [(1, 1, 1), (63, 1, 2), (64, 1, 3), (65, 1, 7), (50, 100, 4), (500, 300, 1)] {
        let ground = random_ground(&mut random, width, height);
        let layers: Vec<_> = (0..count).map(|_| (random_layer(&mut random), random_drawing(&mut random, width, height))).collect();
        let drawn: Vec<Vec<f32>> = layers.iter().map(|(_, drawn)| drawn.values().iter().map(|&t| t as f32).collect()).collect();
        let grounds: Vec<_> = texels(&ground).iter().map(|texel| texel.painted).collect();
        let found = blend(gpu, &grounds, &layers.iter().zip(&drawn).map(|((layer, _), drawn)| (layer, &drawn[..])).collect::<Vec<_>>());
        let expected = reference::alpha_blend(&ground, &layers.iter().map(|(layer, drawn)| (layer, drawn)).collect::<Vec<_>>());
        let worst = worst_difference(found.iter().flat_map(|texel| texel.map(f64::from)), expected.values().iter().flat_map(|texel| expected_values(texel).into_iter().take(4)));
        // Three roundings a layer of values up to 1.5.
        hold("alpha_blend: colour and coverage", worst, 2e-6);
    }
}
