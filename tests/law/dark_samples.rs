use half::f16;
use overpaint::{
    data::OCTET,
    gpu::Gpu,
    model::FitSettings,
    stage::{self, Tile},
};

use crate::{
    parity::dark_samples::lit,
    support::{hold, random::Random, tile},
};

crate::suite! { plain: the_fraction_is_checked; gpu: all_else_keeps_its_bits, shadows_no_longer_lower_the_quantile, nothing_is_below_no_fraction; }

const TEXELS: usize = 70;

fn the_fraction_is_checked() {
    let checked = |dark_fraction| FitSettings { dark_fraction, ..FitSettings::default() }.checked();
    for possible in [0.0, 0.2, 1.0] {
        assert!(checked(possible).is_ok());
    }
    for wrong in [-0.1, 1.1, f64::NAN, f64::INFINITY] {
        let error = checked(wrong).expect_err("is impossible").to_string();
        assert!(error.contains("dark_fraction") && error.contains("from 0 to 1"), "{error}");
    }
}

/// Every half there is, three at a time: bits change in all channels to those of -1, or in none.
fn all_else_keeps_its_bits(gpu: &Gpu) {
    let octets = 0x8000 / OCTET;
    // From 0 to the largest finite, and what is masked with numbers other than -1; -0 does not occur in tiles.
    let half = |index: usize| f16::from_bits(index as u16);
    let finite = |half: f16| if half.is_finite() && half.to_bits() != f16::NEG_ZERO.to_bits() { half } else { f16::ONE };
    let values: Vec<[f16; OCTET]> =
        (0..6 * octets).map(|at| [0, 1, 2, 3, 4, 5, 6, 7].map(|i| finite(half(at % (2 * octets) * OCTET + i)))).collect();
    let reflectance = Tile { values: gpu.upload("tile", &values).expect("fits"), texels: 2 * octets, samples: OCTET };
    let [given, found] = lit(gpu, &reflectance, &vec![[1.0, 1.0, 1.0, 0.0]; 2 * octets], 0.25);
    for (given, found) in given.as_flattened().iter().zip(found.as_flattened()) {
        let dark = given.is_sign_positive() && given.to_f64() < 0.25;
        assert_eq!(found.to_bits(), if dark { f16::NEG_ONE } else { *given }.to_bits(), "{given}");
    }
}

/// A third of the samples in shadow: the quantile is that of the others.
fn shadows_no_longer_lower_the_quantile(gpu: &Gpu) {
    let mut random = Random::new(101);
    let reflectance = tile::upload(gpu, TEXELS, 300, |_, sample, _| if sample % 3 == 0 { 0.01 } else { random.between(0.5, 1.0) });
    let quantile = stage::Percentile::new(gpu).expect("builds");
    let dark = stage::DarkSamples::new(gpu).expect("builds");
    let settings = FitSettings::default();
    let mut recorder = gpu.recorder();
    let median = quantile.record(&mut recorder, &reflectance, 0.5).expect("records");
    let lit = dark.record(&mut recorder, &reflectance, &median, &settings).expect("records");
    let before = quantile.record(&mut recorder, &reflectance, 0.1).expect("records");
    let after = quantile.record(&mut recorder, &lit, 0.1).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    for rho in before.read(gpu).expect("reads").as_flattened().iter().filter(|rho| **rho != 0.0) {
        assert!((0.009..0.011).contains(rho));
    }
    for texel in after.read(gpu).expect("reads") {
        for rho in &texel[..3] {
            // The tenth percentile of 200 numbers from 0.5 to 1 is 0.55 with a standard deviation of 0.011.
            hold("dark_samples: quantile", (f64::from(*rho) - 0.55).abs(), 0.055);
        }
    }
}

fn nothing_is_below_no_fraction(gpu: &Gpu) {
    let mut random = Random::new(103);
    let reflectance = tile::upload_masked(gpu, TEXELS, 43, tile::a_quarter, |_, _, _| random.unit());
    let [given, found] = lit(gpu, &reflectance, &[[1.0; 4]; TEXELS], 0.0);
    assert!(given == found);
    // A texel without valid samples has no median.
    let [given, found] = lit(gpu, &reflectance, &[[0.0; 4]; TEXELS], 1.0);
    assert!(given == found);
}
