use overpaint::{
    data::{Direction, Samples},
    gpu::Gpu,
};

use crate::{
    parity::brdf_values::reflectance,
    support::{Worst, hold, random::Random, tile},
};

crate::suite! { gpu: a_lambertian_texel_is_the_same_under_every_light, a_fault_of_the_measurement_becomes_the_largest_half; }

/// Albedos of n/32 under cosines of m/64: the radiance is a half exactly.
fn a_lambertian_texel_is_the_same_under_every_light(gpu: &Gpu) {
    let (texels, cosines) = (29, (16..=64).map(|m| f64::from(m) / 64.0).collect::<Vec<_>>());
    let mut random = Random::new(61);
    let mut pair = |cosine: f64| {
        let mut phi = || random.between(0.0, std::f64::consts::TAU);
        (Direction { theta: 0.5, phi: phi() }, Direction { theta: cosine.acos(), phi: phi() })
    };
    let directions = Samples::new(cosines.iter().map(|&cosine| pair(cosine)).collect());
    let albedo = |channel: usize, texel: usize| (1 + texel + channel) as f64 / 32.0;
    let radiance = tile::upload(gpu, texels, cosines.len(), |channel, sample, texel| albedo(channel, texel) * cosines[sample]);
    let found = reflectance(gpu, &radiance, &directions);
    let plane = found.len() / 3;
    for channel in 0..3 {
        let found = &found[channel * plane..][..cosines.len() * texels];
        let errors = found.iter().enumerate().map(|(index, found)| (found / albedo(channel, index % texels) - 1.0).abs());
        // One unit in the last place of a half: the driver may truncate.
        hold("brdf_values: Lambertian texels", errors.worst(), 1.0 / 1024.0);
    }
}

fn a_fault_of_the_measurement_becomes_the_largest_half(gpu: &Gpu) {
    let directions = tile::directions(&mut Random::new(1), 8);
    let radiance = tile::upload(gpu, 64, 8, |_, _, _| 65504.0);
    assert_eq!(reflectance(gpu, &radiance, &directions), [65504.0; 3 * 8 * 64]);
}
