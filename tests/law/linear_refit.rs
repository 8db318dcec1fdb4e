use overpaint::{gpu::Gpu, reference::LocalSample};

use crate::{
    parity::linear_refit::errors,
    support::{Worst, hold, local::Local, random::Random, tile},
};

crate::suite! {
    gpu: known_coefficients_are_found, the_conditions_of_the_minimum_hold, nothing_near_is_better, masked_and_unlit_samples_change_nothing,
        black_gives_zeros, lobes_that_say_nothing_are_left_out, columns_that_depend_on_each_other, hostile_lobes_give_finite_numbers;
}

const TEXELS: usize = 70;

/// Zeros among them in each place.
fn known(texel: usize) -> Vec<[f64; 3]> {
    let mut random = Random::new(texel as u64);
    (0..4).map(|_| [0; 3].map(|_| if random.below(3) == 0 { 0.0 } else { random.between(0.1, 1.0) })).collect()
}

/// Largest error of a coefficient of a texel, in the measure of what it does: times the length of its column over that of ρ_d's.
fn distance(local: &Local, texel: usize, found: &[[f64; 3]], expected: &[[f64; 3]]) -> f64 {
    let lobes = local.lobes_of(texel);
    let mut energies = vec![0.0; found.len()];
    for sample in 0..local.samples.len() {
        let responses = local.sample(sample, texel, [0.0; 3]).responses(&lobes);
        energies.iter_mut().zip(responses).for_each(|(energy, response)| *energy += response * response);
    }
    let error = |column: usize| {
        let lengths = (energies[column] / energies[0]).sqrt();
        [0, 1, 2].map(|channel| lengths * (found[column][channel] - expected[column][channel]).abs())
    };
    (0..found.len()).flat_map(error).worst()
}

fn known_coefficients_are_found(gpu: &Gpu) {
    for lobes in 1..=3 {
        let local = Local::new(&mut Random::new(31), TEXELS, 700, 4, lobes);
        let radiance = local.tile(gpu, known, |_, _, _, value| value);
        for (texel, found) in local.refit(gpu, &radiance).into_iter().enumerate() {
            let expected = known(texel);
            assert_eq!(found.len(), 1 + lobes);
            // The radiance is rounded to halves, 2^-12 of it in the mean, of which hundreds of samples leave a tenth; where columns are
            // nearly dependent that grows tenfold.
            hold("linear_refit: known coefficients", distance(&local, texel, &found, &expected), 2.4e-4);
        }
    }
}

/// A tile that no coefficients fit.
fn noisy(gpu: &Gpu, local: &Local, seed: u64) -> overpaint::stage::Tile {
    let mut random = Random::new(seed);
    local.tile(gpu, known, |_, _, _, value| (value + random.between(-0.3, 0.3)).max(0.0))
}

/// Per column: its length, and the squared error's derivative by its coefficient at length 1, as a part of the radiance's length.
fn slopes(samples: &[LocalSample], lobes: &[[f64; 4]], channel: usize, found: &[[f64; 3]]) -> Vec<f64> {
    let (mut of_column, mut energy, mut all) = (vec![0.0; found.len()], vec![0.0; found.len()], 0.0);
    for sample in samples {
        let responses = sample.responses(lobes);
        let model: f64 = responses.iter().zip(found).map(|(response, rho)| response * rho[channel]).sum();
        let lit = sample.shading > 0.0;
        all += if lit { sample.radiance[channel].powi(2) } else { 0.0 };
        for (column, response) in responses.into_iter().enumerate() {
            of_column[column] += response * (sample.radiance[channel] - model);
            energy[column] += response * response;
        }
    }
    of_column.iter().zip(energy).map(|(slope, energy)| slope / (energy * all).sqrt()).collect()
}

/// Karush-Kuhn-Tucker: no slope where a coefficient is positive, none that a coefficient of 0 could follow.
fn the_conditions_of_the_minimum_hold(gpu: &Gpu) {
    let (mut positive, mut zero) = (0, 0);
    for lobes in 1..=3 {
        let local = Local::new(&mut Random::new(37), TEXELS, 400, 4, lobes);
        let radiance = noisy(gpu, &local, 5);
        let given = tile::unpack(&radiance.values.read(gpu).expect("reads"), TEXELS);
        for (texel, found) in local.refit(gpu, &radiance).iter().enumerate() {
            let samples = local.samples_of(texel, &given);
            for channel in 0..3 {
                for (slope, rho) in slopes(&samples, &local.lobes_of(texel), channel, found).into_iter().zip(found) {
                    assert!(rho[channel] >= 0.0);
                    let is_positive = rho[channel] > 0.0;
                    (positive, zero) = (positive + usize::from(is_positive), zero + usize::from(!is_positive));
                    // Each lobe is off by 1e-5 (log2 and exp2), the sums by 1e-6.
                    hold("linear_refit: slope at the minimum", if is_positive { slope.abs() } else { slope }, 2e-5);
                }
            }
        }
    }
    assert!(positive > 1000 && zero > 100, "{positive} coefficients above 0 and {zero} at it");
}

fn nothing_near_is_better(gpu: &Gpu) {
    let local = Local::new(&mut Random::new(41), 20, 300, 4, 3);
    let radiance = noisy(gpu, &local, 7);
    let given = tile::unpack(&radiance.values.read(gpu).expect("reads"), 20);
    let mut random = Random::new(43);
    for (texel, found) in local.refit(gpu, &radiance).iter().enumerate() {
        let (samples, lobes) = (local.samples_of(texel, &given), local.lobes_of(texel));
        for step in [1.0, 0.1, 0.01, 1e-3] {
            for _ in 0..10 {
                let other: Vec<_> = found.iter().map(|rho| rho.map(|rho| (rho + step * random.between(-1.0, 1.0)).max(0.0))).collect();
                for channel in 0..3 {
                    let [(_, here), (_, there)] = [found, &other].map(|rho| errors(&samples, &lobes, channel, rho, rho));
                    // What slopes of 2e-5 leave to gain over curvatures of 0.01 and more.
                    hold("linear_refit: gain of another point", (here - there).max(0.0), 1e-7);
                }
            }
        }
    }
}

fn masked_and_unlit_samples_change_nothing(gpu: &Gpu) {
    let mut local = Local::new(&mut Random::new(47), TEXELS, 203, 4, 3);
    let plain = noisy(gpu, &local, 9);
    let given = tile::unpack(&plain.values.read(gpu).expect("reads"), TEXELS);
    let plane = given.len() / 3;
    let shading = local.shading.clone();
    for (index, shading) in local.shading.iter_mut().enumerate() {
        if tile::a_quarter(index / TEXELS, index % TEXELS) {
            *shading = 0.0;
        }
    }
    let unlit = local.refit(gpu, &plain);
    let with = |local: &Local, value: f64| {
        let radiance = tile::upload(gpu, TEXELS, 203, |channel, sample, texel| {
            if tile::a_quarter(sample, texel) { value } else { given[channel * plane + sample * TEXELS + texel] }
        });
        local.refit(gpu, &radiance)
    };
    for value in [-1.0, -0.25, 0.0, 3.0, 60_000.0] {
        assert!(unlit == with(&local, value), "{value} where no light comes");
    }
    local.shading = shading;
    assert!(unlit == with(&local, -1.0), "masked where light comes");
    assert!(unlit != with(&local, 3.0), "the samples matter otherwise");
}

fn black_gives_zeros(gpu: &Gpu) {
    let mut local = Local::new(&mut Random::new(53), TEXELS, 20, 2, 3);
    let zeros = vec![vec![[0.0; 3]; 4]; TEXELS];
    assert_eq!(local.refit(gpu, &tile::upload(gpu, TEXELS, 20, |_, _, _| 0.0)), zeros);
    assert_eq!(local.refit(gpu, &tile::upload(gpu, TEXELS, 20, |_, _, _| -1.0)), zeros);
    local.shading.fill(0.0);
    assert_eq!(local.refit(gpu, &tile::upload(gpu, TEXELS, 20, |_, _, _| 1.0)), zeros);
}

/// A lobe that no sample meets has 0, and the others what they would have without it.
fn lobes_that_say_nothing_are_left_out(gpu: &Gpu) {
    let mut local = Local::new(&mut Random::new(59), TEXELS, 200, 4, 3);
    let radiance = noisy(gpu, &local, 11);
    for faint in [[0.0, 0.0, 0.0, 1.0], [-0.5, -0.5, -1.0, 2.0], [-1e-4, -1e-4, 1e-4, 2.0]] {
        local.lobes.truncate(2 * TEXELS);
        let without = local.refit(gpu, &radiance);
        local.lobes.extend([faint; TEXELS]);
        for (found, without) in local.refit(gpu, &radiance).iter().zip(without) {
            // The lobe (-0.5, -0.5, -1) has samples whose tangents outweigh the normal's component.
            if faint[2] >= 0.0 {
                assert_eq!(found[3], [0.0; 3]);
                assert_eq!(found[..3], without);
            }
            assert!(found.iter().flatten().all(|rho| (0.0..1e4).contains(rho)), "{found:?}");
        }
    }
}

/// Under a single pair of directions all columns are the same, and two equal lobes are under any: the first has it all.
fn columns_that_depend_on_each_other(gpu: &Gpu) {
    let mut local = Local::new(&mut Random::new(61), TEXELS, 40, 1, 3);
    let pair = local.samples.directions()[0];
    local.samples = overpaint::data::Samples::new(vec![pair; 40]);
    let radiance = local.tile(gpu, |_| vec![[0.5, 0.25, 1.0]], |_, _, _, value| value);
    for (texel, found) in local.refit(gpu, &radiance).iter().enumerate() {
        if (0..40).all(|sample| local.shading[sample * TEXELS + texel] == 0.0) {
            continue;
        }
        assert_eq!(found[1..], [[0.0; 3]; 3]);
        let error = found[0].iter().zip([0.5, 0.25, 1.0]).map(|(found, expected)| (found - expected).abs());
        // Rounding of the radiance to halves.
        hold("linear_refit: one pair of directions", error.worst(), 1e-3);
    }

    let mut local = Local::new(&mut Random::new(67), TEXELS, 400, 4, 3);
    for texel in 0..TEXELS {
        local.lobes[TEXELS + texel] = local.lobes[texel];
    }
    let radiance = local.tile(gpu, |_| vec![[0.5; 3], [0.2; 3], [0.3; 3], [0.4; 3]], |_, _, _, value| value);
    for (texel, found) in local.refit(gpu, &radiance).into_iter().enumerate() {
        assert_eq!(found[2], [0.0; 3]);
        // As with known coefficients.
        hold("linear_refit: equal lobes", distance(&local, texel, &found, &[[0.5; 3], [0.5; 3], [0.0; 3], [0.4; 3]]), 2.4e-4);
    }
}

fn hostile_lobes_give_finite_numbers(gpu: &Gpu) {
    let mut local = Local::new(&mut Random::new(71), TEXELS, 200, 4, 3);
    let radiance = noisy(gpu, &local, 13);
    let hostile = [[-1e3, -1e3, 1e3, 1000.0], [1.0, 1.0, 1.0, 1e4], [-1e-30, -1e-30, 1e-30, 10.0], [-40.0, -40.0, 40.0, 40.0]];
    for [x, y, z, n] in hostile {
        for lobe in 0..3 {
            local.lobes[lobe * TEXELS..(lobe + 1) * TEXELS].fill([x, y, z, n * (1.0 + lobe as f32)]);
        }
        for found in local.refit(gpu, &radiance) {
            assert!(found.iter().flatten().all(|rho| (0.0..1e5).contains(rho)), "{found:?}");
        }
    }
}
