use overpaint::{
    data::Map,
    gpu::Gpu,
    model::{Layer, Paint},
    reference, stage,
};

use crate::support::{Worst, hold, probe::probe, random::Random, worst_difference};

crate::suite! { gpu: agrees_with_its_twin, a_million_films_are_finite_and_agree; }

/// 10^between(low, high) in f32, now and then exactly 0.
fn over_decades(random: &mut Random, low: f64, high: f64) -> f64 {
    if random.below(20) == 0 { 0.0 } else { f64::from(10_f64.powf(random.between(low, high)) as f32) }
}

fn agrees_with_its_twin(gpu: &Gpu) {
    let stage = stage::KubelkaMunk::new(gpu).expect("builds");
    let mut random = Random::new(11);
    // Both sides of a workgroup, a single texel, and one past 65,535 workgroups of 64.
    for (width, height) in [(1, 1), (63, 1), (64, 1), (65, 1), (50, 100), (64 * 257, 256)] {
        let channels = |random: &mut Random| std::array::from_fn(|_| over_decades(random, -6.0, 3.0));
        let paint = Paint { name: "random".to_owned(), k: channels(&mut random), s: channels(&mut random) };
        let layer = Layer::new(paint, random.between(0.1, 2.0), 0.0);
        // Grounds up to 1.5: measured reflectances exceed 1. Half of the texels are drawn near or below the closing thickness.
        let grounds =
            Map::from_fn(width, height, |_, _| [(); 4].map(|()| random.unit() as f32)).map(|g| [1.5 * g[0], 1.5 * g[1], 1.5 * g[2], g[3]]);
        let drawn = Map::from_fn(width, height, |_, _| if random.below(2) == 0 { random.unit() } else { 0.08 * random.unit() } as f32);
        let ground_buffer = gpu.upload("ground", grounds.values()).expect("fits");
        let drawn_buffer = gpu.upload("drawn", drawn.values()).expect("fits");
        let mut recorder = gpu.recorder();
        let painted = stage.record(&mut recorder, &ground_buffer, &drawn_buffer, &layer).expect("records");
        gpu.submit(recorder).wait(gpu).expect("runs");
        let found = painted.read(gpu).expect("reads");
        let expected = reference::kubelka_munk(&grounds.map(|g| g.map(f64::from)), &drawn.map(|&t| f64::from(t)), &layer);
        let found = found.iter().flat_map(|texel| texel.map(f64::from));
        // A dozen roundings of values up to 1.5 (1.2e-7 each at most), and exp to 3 units in the last place.
        hold("kubelka_munk: reflectance and coverage", worst_difference(found, expected.values().iter().copied().flatten()), 1e-6);
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

/// s and k from 1e-6 to 1e3 and 0, each on its own, over grounds from 0 to 2.
fn a_million_films_are_finite_and_agree(gpu: &Gpu) {
    let mut random = Random::new(5);
    let films: Vec<_> = (0..1_000_000)
        .map(|_| [over_decades(&mut random, -6.0, 3.0), over_decades(&mut random, -6.0, 3.0), 2.0 * random.unit(), 0.0].map(|v| v as f32))
        .collect();
    let found = probe(gpu, FILM, &films, films.len());
    let (mut errors, mut energy, mut over) = (Vec::new(), Vec::new(), Vec::new());
    for (film, found) in films.iter().zip(found) {
        let [s, k, ground, _] = film.map(f64::from);
        let [r, complement, t, above] = found.map(f64::from);
        assert!(found.iter().all(|value| value.is_finite()), "s {s:e}, k {k:e}, ground {ground}: {found:?}");
        let [expected_r, expected_t] = reference::film(s, k);
        let white = ground.min(1.0);
        let through = expected_t * expected_t;
        let expected_above = expected_r + through / (1.0 - expected_r * white) * white + through * (ground - white);
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
