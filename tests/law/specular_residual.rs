use overpaint::{gpu::Gpu, stage};

use crate::{
    parity::specular_residual::residual,
    support::{random::Random, tile},
};

crate::suite! {
    gpu: nothing_is_left_at_or_below_the_diffuse_part, a_constant_added_to_both_does_not_matter, what_follows_the_last_sample_becomes_zero,
        the_largest_residual_is_finite;
}

const TEXELS: usize = 70;
const SAMPLES: usize = 27;

/// Multiples of 1/256 below 1: they and their sums with 1/2 are halves exactly.
fn steps(random: &mut Random) -> f32 {
    random.below(256) as f32 / 256.0
}

fn nothing_is_left_at_or_below_the_diffuse_part(gpu: &Gpu) {
    let mut random = Random::new(67);
    let diffuse: Vec<_> = (0..TEXELS).map(|_| [(); 4].map(|()| steps(&mut random))).collect();
    for share in [1.0, 0.9, 0.0] {
        let reflectance = tile::upload(gpu, TEXELS, SAMPLES, |channel, _, texel| share * f64::from(diffuse[texel][channel]));
        assert!(residual(gpu, &reflectance, &diffuse).iter().all(|value| *value == 0.0));
    }
}

fn a_constant_added_to_both_does_not_matter(gpu: &Gpu) {
    let mut random = Random::new(71);
    let diffuse: Vec<_> = (0..TEXELS).map(|_| [(); 4].map(|()| steps(&mut random))).collect();
    let values: Vec<_> = (0..3 * SAMPLES * TEXELS).map(|_| steps(&mut random)).collect();
    let with = |constant: f32| {
        let value = |channel: usize, sample: usize, texel: usize| values[(channel * SAMPLES + sample) * TEXELS + texel] + constant;
        let reflectance = tile::upload(gpu, TEXELS, SAMPLES, |channel, sample, texel| f64::from(value(channel, sample, texel)));
        let diffuse: Vec<_> = diffuse.iter().map(|rho| rho.map(|rho| rho + constant)).collect();
        residual(gpu, &reflectance, &diffuse)
    };
    let plain = with(0.0);
    assert!(plain.iter().any(|value| *value > 0.1));
    assert_eq!(plain, with(0.5));
}

fn what_follows_the_last_sample_becomes_zero(gpu: &Gpu) {
    for samples in [1_usize, 3, 5, 9] {
        let full = tile::upload(gpu, 5, samples.next_multiple_of(8), |_, _, _| 1.0);
        let reflectance = stage::Tile { samples, ..full };
        for (index, found) in residual(gpu, &reflectance, &[[0.25; 4]; 5]).into_iter().enumerate() {
            assert_eq!(found, if index / 5 < samples { 0.75 } else { 0.0 });
        }
    }
}

/// Its mean over the channels may be rounded up, but no further than to the largest half; down by one unit in a half's last place, 32.
fn the_largest_residual_is_finite(gpu: &Gpu) {
    let reflectance = tile::upload(gpu, TEXELS, 8, |_, _, _| 65504.0);
    let found = residual(gpu, &reflectance, &[[0.0; 4]; TEXELS]);
    assert!(found.iter().all(|value| (65472.0..=65504.0).contains(value)));
}
