use overpaint::gpu::Gpu;

use crate::{
    parity::radiance_error::radiance_error,
    support::{Worst, hold, local::Local, random::Random, tile},
};

crate::suite! { gpu: the_model_itself_has_no_error, black_has_the_error_of_the_radiance, masked_samples_do_not_count,
    lobes_without_a_share_change_nothing; }

const TEXELS: usize = 70;
const SAMPLES: usize = 203;

/// ρ_d, then each ρ_s.
const KNOWN: [[f32; 4]; 4] = [[0.5, 0.25, 1.0, 0.0], [0.1, 0.2, 0.3, 0.0], [0.4, 0.0, 0.6, 0.0], [1.0, 2.0, 0.5, 0.0]];

fn planes(scale: f32) -> Vec<[f32; 4]> {
    KNOWN.iter().flat_map(|rho| [rho.map(|rho| scale * rho); TEXELS]).collect()
}

fn known(_: usize) -> Vec<[f64; 3]> {
    KNOWN.iter().map(|rho| [0, 1, 2].map(|channel| f64::from(rho[channel]))).collect()
}

fn the_model_itself_has_no_error(gpu: &Gpu) {
    let local = Local::new(&mut Random::new(79), TEXELS, SAMPLES, 4, 3);
    let radiance = local.tile(gpu, known, |_, _, _, value| value);
    for [squares, of_radiance, error, sum] in radiance_error(gpu, &local, &radiance, &planes(1.0)) {
        // Rounding of the radiance to halves, 2^-11 at most.
        hold("radiance_error: known model", (squares / of_radiance).sqrt(), 4.9e-4);
        hold("radiance_error: known model, bias", error.abs() / sum, 4.9e-4);
    }
    // Twice the model is off by the radiance itself.
    for [squares, of_radiance, error, sum] in radiance_error(gpu, &local, &radiance, &planes(2.0)) {
        hold("radiance_error: twice the model", (squares / of_radiance - 1.0).abs(), 2e-3);
        hold("radiance_error: twice the model, bias", (error / sum - 1.0).abs(), 1e-3);
    }
}

/// Sums of unlit samples too, and no filling.
fn black_has_the_error_of_the_radiance(gpu: &Gpu) {
    let mut local = Local::new(&mut Random::new(83), TEXELS, SAMPLES, 4, 3);
    let radiance = tile::upload(gpu, TEXELS, SAMPLES, |_, _, _| 0.5);
    let expected = [0.75 * SAMPLES as f64, 0.75 * SAMPLES as f64, -1.5 * SAMPLES as f64, 1.5 * SAMPLES as f64];
    assert_eq!(radiance_error(gpu, &local, &radiance, &planes(0.0)), [expected; TEXELS]);
    local.shading.fill(0.0);
    assert_eq!(radiance_error(gpu, &local, &radiance, &planes(1.0)), [expected; TEXELS]);
}

/// What is masked may as well be what the model says.
fn masked_samples_do_not_count(gpu: &Gpu) {
    let local = Local::new(&mut Random::new(89), TEXELS, SAMPLES, 4, 3);
    let noise = |sample: usize, texel: usize| 0.1 * Random::new((sample * TEXELS + texel) as u64).unit();
    let with = |masked: f64| {
        let radiance = local.tile(gpu, known, |_, sample, texel, value| {
            if tile::a_quarter(sample, texel) { masked } else { value + noise(sample, texel) }
        });
        radiance_error(gpu, &local, &radiance, &planes(1.0))
    };
    let plain = with(-1.0);
    assert!(plain == with(-0.25), "any negative number masks");
    assert!(plain != with(0.0), "and zero does not");
    let model = local.tile(gpu, known, |_, sample, texel, value| value + if tile::a_quarter(sample, texel) { 0.0 } else { noise(sample, texel) });
    let whole = radiance_error(gpu, &local, &model, &planes(1.0));
    // Rounding of the model to halves.
    hold("radiance_error: masked", plain.iter().zip(whole).map(|(a, b)| (a[0] - b[0]).abs() / b[0]).worst(), 1e-4);
}

/// Even if they are out of single precision's range.
fn lobes_without_a_share_change_nothing(gpu: &Gpu) {
    let mut local = Local::new(&mut Random::new(107), TEXELS, SAMPLES, 4, 3);
    let radiance = local.tile(gpu, known, |_, _, _, value| value);
    let mut planes = planes(1.0);
    planes[TEXELS..].fill([0.0; 4]);
    let plain = radiance_error(gpu, &local, &radiance, &planes);
    local.lobes.fill([-1e3, -1e3, 1e3, 1000.0]);
    assert_eq!(radiance_error(gpu, &local, &radiance, &planes), plain);
}
