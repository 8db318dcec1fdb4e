use overpaint::{gpu::Gpu, stage};

use crate::support::{random::Random, tile};

crate::suite! { gpu: a_tenth_lies_below_the_tenth_percentile, order_does_not_matter, what_follows_the_last_sample_does_not_matter; }

fn quantiles(gpu: &Gpu, tile: &stage::Tile, quantile: f64) -> Vec<[f32; 4]> {
    let stage = stage::Percentile::new(gpu).expect("builds");
    let mut recorder = gpu.recorder();
    let quantiles = stage.record(&mut recorder, tile, quantile).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    quantiles.read(gpu).expect("reads")
}

fn a_tenth_lies_below_the_tenth_percentile(gpu: &Gpu) {
    let (texels, samples) = (70, 1001);
    let mut random = Random::new(53);
    let tile = tile::upload(gpu, texels, samples, |_, _, _| random.unit().powi(3));
    let values = tile::unpack(&tile.values.read(gpu).expect("reads"), texels);
    for (texel, quantile) in quantiles(gpu, &tile, 0.1).into_iter().enumerate() {
        let column = |sample: usize| values[sample * texels + texel];
        let below = (0..samples).filter(|&sample| column(sample) < f64::from(quantile[0])).count();
        let not_above = (0..samples).filter(|&sample| column(sample) <= f64::from(quantile[0])).count();
        assert!(below <= 100 && not_above >= 101, "{below} below, {not_above} not above");
    }
}

fn order_does_not_matter(gpu: &Gpu) {
    let samples = 203;
    let mut random = Random::new(59);
    let values: Vec<f64> = (0..samples).map(|_| random.unit()).collect();
    let forwards = tile::upload(gpu, 3, samples, |_, sample, _| values[sample]);
    let backwards = tile::upload(gpu, 3, samples, |_, sample, _| values[samples - 1 - sample]);
    assert_eq!(quantiles(gpu, &forwards, 0.1), quantiles(gpu, &backwards, 0.1));
}

fn what_follows_the_last_sample_does_not_matter(gpu: &Gpu) {
    for filling in [0.0, 1.0, -1.0, 60_000.0] {
        let full = tile::upload(gpu, 5, 8, |_, sample, _| if sample < 3 { 10.0 + sample as f64 } else { filling });
        let tile = stage::Tile { samples: 3, ..full };
        assert_eq!(quantiles(gpu, &tile, 0.25), [[10.5, 10.5, 10.5, 0.0]; 5]);
    }
}
