use overpaint::{gpu::Gpu, reference, stage};

use crate::support::{Worst, hold, random::Random, tile};

crate::suite! { gpu: agrees_with_its_twin, order_statistics_are_exact, masked_values_are_left_out, ties, zeros_and_neighbours; }

fn quantiles(gpu: &Gpu, tile: &stage::Tile, quantile: f64) -> Vec<[f32; 4]> {
    let stage = stage::Percentile::new(gpu).expect("builds");
    let mut recorder = gpu.recorder();
    let quantiles = stage.record(&mut recorder, tile, quantile).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    quantiles.read(gpu).expect("reads")
}

/// Worst difference over all texels and channels from the quantile of a sort.
fn worst(gpu: &Gpu, texels: usize, samples: usize, quantile: f64, mut value: impl FnMut(usize) -> f64) -> f64 {
    let tile = tile::upload(gpu, texels, samples, |_, sample, _| value(sample));
    let given = tile::unpack(&tile.values.read(gpu).expect("reads"), texels);
    let found = quantiles(gpu, &tile, quantile);
    let filled = tile.octets() * 8;
    let mut errors = Vec::new();
    for texel in 0..texels {
        assert_eq!(found[texel][3].to_bits(), 0);
        for channel in 0..3 {
            let values: Vec<f64> = (0..samples).map(|sample| given[(channel * filled + sample) * texels + texel]).collect();
            let expected = reference::percentile(&values, quantile).unwrap_or(0.0);
            errors.push((f64::from(found[texel][channel]) - expected).abs());
        }
    }
    errors.into_iter().worst()
}

fn agrees_with_its_twin(gpu: &Gpu) {
    for (texels, samples) in [(1, 1), (63, 2), (64, 7), (65, 8), (5, 9), (130, 63), (3, 65), (2, 6561)] {
        for quantile in [0.0, 0.1, 0.37, 0.5, 1.0] {
            let mut random = Random::new(11);
            // The order statistics are exact; the rule between them is one f32 multiply-add of values below 2.
            hold("percentile", worst(gpu, texels, samples, quantile, |_| random.between(0.0, 2.0)), 2.4e-7);
        }
    }
}

/// 0.1 of 81 samples is the 8th exactly: no interpolation, so no difference at all.
fn order_statistics_are_exact(gpu: &Gpu) {
    let mut random = Random::new(12);
    hold("percentile: order statistic", worst(gpu, 64 * 70, 81, 0.1, |_| random.between(0.0, 1.0)), 0.0);
}

/// From hardly any to all: the rank is that of the valid values, whatever their number.
fn masked_values_are_left_out(gpu: &Gpu) {
    let mut random = Random::new(14);
    for samples in [1, 9, 64, 203] {
        for share in [0.01, 0.5, 0.95, 1.0] {
            let mut value = |_| if random.unit() < share { -random.between(0.5, 60_000.0) } else { random.between(0.0, 2.0) };
            for quantile in [0.1, 0.37, 0.9] {
                hold("percentile: masked", worst(gpu, 70, samples, quantile, &mut value), 2.4e-7);
            }
            for quantile in [0.0, 1.0] {
                hold("percentile: least and greatest of masked", worst(gpu, 70, samples, quantile, &mut value), 0.0);
            }
        }
    }
    // Order statistics exactly, by their neighbours in bits: 0.1 of n samples is one where n - 1 is a multiple of 10.
    let mut index = 0;
    let value = |sample: usize| {
        index += 1;
        if sample % 5 < 3 { -1.0 } else { half::f16::from_bits(0x2e66 + (7 * index % 400) as u16).to_f64() }
    };
    hold("percentile: order statistic of masked", worst(gpu, 70, 254, 0.1, value), 0.0);
}

fn ties(gpu: &Gpu) {
    let mut random = Random::new(13);
    for samples in [10, 16, 41, 100] {
        let few = [-2.0, -0.5, 0.0, 0.25, 0.25, 3.0];
        hold("percentile: ties", worst(gpu, 70, samples, 0.1, |_| few[random.below(6)]), 4.8e-7);
        hold("percentile: ties", worst(gpu, 70, samples, 0.83, |_| few[random.below(6)]), 4.8e-7);
    }
}

/// Zero, the least, and ties on a half whose neighbour is the next one, at every phase of the two-bit digits.
fn zeros_and_neighbours(gpu: &Gpu) {
    let mut cases = vec![vec![-1.0, 0.0, 0.0, 0.0, 2.0], vec![6e-8, 0.0, 2.0, -1.0, 0.0]];
    for base in 0..4 {
        cases.push([0, 0, 0, 1, 7].map(|step| half::f16::from_bits(0x3c00 + base + step).to_f64()).to_vec());
    }
    for values in cases {
        for quantile in [0.1, 0.4, 0.5, 0.75, 0.875, 0.9] {
            hold("percentile: zeros and neighbours", worst(gpu, 3, 5, quantile, |sample| values[sample]), 2.4e-7);
        }
    }
}
