use overpaint::{
    data::Map,
    gpu::Gpu,
    model::{Layer, Paint},
    reference::{self, PaintedTexel},
};

use crate::support::{
    Worst, hold,
    paint::{Texel, lay},
    probe::probe,
    random::Random,
    worst_difference,
};

crate::suite! { gpu: agrees_with_its_twin, a_million_films_are_finite_and_agree; }

/// 10^between(low, high) in f32, now and then exactly 0.
fn over_decades(random: &mut Random, low: f64, high: f64) -> f64 {
    if random.below(20) == 0 { 0.0 } else { f64::from(10_f64.powf(random.between(low, high)) as f32) }
}

/// A layer of any paint.
pub fn random_layer(random: &mut Random) -> Layer {
    let [k, s] = [(); 2].map(|()| std::array::from_fn(|_| over_decades(random, -6.0, 3.0)));
    let layer = Layer::new(Paint { name: "random".to_owned(), k, s }, random.between(0.1, 2.0), random.between(0.0, 3.0));
    Layer { refractive_index: random.between(1.0, 3.0), roughness: random.between(0.05, 1.0), ..layer }
}

/// A ground of reflectances up to 1.5 (measured ones exceed 1), every other texel of which is painted already.
pub fn random_ground(random: &mut Random, width: usize, height: usize) -> Map<PaintedTexel> {
    let unit = |random: &mut Random| f64::from(random.unit() as f32);
    Map::from_fn(width, height, |column, _| PaintedTexel {
        reflectance: std::array::from_fn(|_| 1.5 * unit(random)),
        coverage: if column % 2 == 0 { 0.0 } else { unit(random) },
        coat: [unit(random), unit(random)],
        height: f64::from(random.between(-3.0, 3.0) as f32),
    })
}

/// Half of the texels are drawn near or below the closing thickness, some next to nothing and some not at all.
pub fn random_drawing(random: &mut Random, width: usize, height: usize) -> Map<f64> {
    Map::from_fn(width, height, |_, _| {
        let most = [0.0, 10_f64.powf(random.between(-8.0, -4.0)), 0.08, 0.08, 1.0, 1.0, 1.0][random.below(7)];
        f64::from((most * random.unit()) as f32)
    })
}

/// The ground as the adapter has it.
pub fn texels(ground: &Map<PaintedTexel>) -> Vec<Texel> {
    let texel = |texel: &PaintedTexel| {
        let [r, g, b] = texel.reflectance.map(|v| v as f32);
        Texel { painted: [r, g, b, texel.coverage as f32], coat: texel.coat.map(|v| v as f32), height: texel.height as f32 }
    };
    ground.values().iter().map(texel).collect()
}

/// Reflectance, coverage, F₀ and α of the twin.
pub fn expected_values(texel: &PaintedTexel) -> [f64; 6] {
    let [r, g, b] = texel.reflectance;
    [r, g, b, texel.coverage, texel.coat[0], texel.coat[1]]
}

fn agrees_with_its_twin(gpu: &Gpu) {
    let mut random = Random::new(11);
    // Both sides of a workgroup and a single texel; one layer, several, and several in batches. A plane past 65,535 workgroups of 64 is larger
    // than a binding of WebGPU's least size.
    let cases = [(1, 1, 1, 1), (63, 1, 2, 2), (64, 1, 3, 2), (65, 1, 7, 3), (50, 100, 4, 4), (500, 300, 1, 1)];
    for (width, height, count, batch) in cases {
        let ground = random_ground(&mut random, width, height);
        let layers: Vec<_> = (0..count).map(|_| (random_layer(&mut random), random_drawing(&mut random, width, height))).collect();
        let drawn: Vec<Vec<f32>> = layers.iter().map(|(_, drawn)| drawn.values().iter().map(|&t| t as f32).collect()).collect();
        let on_gpu: Vec<_> = layers.iter().zip(&drawn).map(|((layer, _), drawn)| (layer, &drawn[..])).collect();
        let found = lay(gpu, &texels(&ground), &on_gpu, batch);

        let expected = reference::kubelka_munk(&ground, &layers.iter().map(|(layer, drawn)| (layer, drawn)).collect::<Vec<_>>());
        let expected_heights = expected.values().iter().map(|texel| texel.height);
        // A dozen roundings of values up to 1.5 (1.2e-7 each at most), and exp to 3 units in the last place, for each of up to 7 layers.
        let worst = worst_difference(found.iter().flat_map(Texel::values), expected.values().iter().flat_map(expected_values));
        hold("kubelka_munk: reflectance, coverage, coat", worst, 2e-6);
        // Up to 24 texel widths, a rounding a layer.
        hold("kubelka_munk: heights", worst_difference(found.iter().map(|texel| f64::from(texel.height)), expected_heights), 8e-6);
    }
}

const FILM: &str = crate::probe!(
    "film",
    "fn probe(index: u32) -> vec4<f32> {
        let given = inputs[index];
        let coat = film(given.xyz, given.yzx);
        return vec4(coat.reflectance.x, coat.complement.x, coat.transmittance.x, over_substrate(coat, given.zzz).x);
    }"
);

/// s and k from 1e-6 to 1e3 and 0, each on its own, over grounds from 0 to 1.
fn a_million_films_are_finite_and_agree(gpu: &Gpu) {
    let mut random = Random::new(5);
    let films: Vec<_> = (0..1_000_000)
        .map(|_| [over_decades(&mut random, -6.0, 3.0), over_decades(&mut random, -6.0, 3.0), random.unit(), 0.0].map(|v| v as f32))
        .collect();
    let found = probe(gpu, FILM, &films, films.len());
    let (mut errors, mut energy, mut over) = (Vec::new(), Vec::new(), Vec::new());
    for (film, found) in films.iter().zip(found) {
        let [s, k, ground, _] = film.map(f64::from);
        let [r, complement, t, above] = found.map(f64::from);
        assert!(found.iter().all(|value| value.is_finite()), "s {s:e}, k {k:e}, ground {ground}: {found:?}");
        let [expected_r, expected_t] = reference::film(s, k);
        let expected_above = expected_r + expected_t * expected_t * ground / (1.0 - expected_r * ground);
        errors.extend([r - expected_r, t - expected_t, complement - 1.0 + expected_r].map(f64::abs));
        over.push((above - expected_above).abs());
        energy.extend([r + t - 1.0, r - 1.0, -r, -t]);
    }
    // A handful of roundings of values up to 1, and exp; 4e-7 is what the same formulas give in f32 on a CPU.
    hold("film: R, 1 - R and T of 1e6 films", errors.into_iter().worst(), 5e-7);
    hold("film: 1e6 films over grounds", over.into_iter().worst(), 1e-6);
    // R + T = 1 without absorption; one rounding each.
    hold("film: R + T - 1 and signs of 1e6 films", energy.into_iter().worst(), 2.5e-7);
}
