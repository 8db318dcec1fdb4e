//! Tiles of samples, made and read back.

use half::f16;
use overpaint::{
    data::{Direction, OCTET, Samples},
    gpu::Gpu,
    stage::Tile,
};

use super::random::Random;

/// A tile whose value is `value(channel, sample, texel)`, rounded to half.
pub fn upload(gpu: &Gpu, texels: usize, samples: usize, mut value: impl FnMut(usize, usize, usize) -> f64) -> Tile {
    let octets = samples.div_ceil(OCTET);
    let mut values = vec![[f16::ZERO; OCTET]; 3 * octets * texels];
    for channel in 0..3 {
        for sample in 0..samples {
            for texel in 0..texels {
                values[(channel * octets + sample / OCTET) * texels + texel][sample % OCTET] = f16::from_f64(value(channel, sample, texel));
            }
        }
    }
    Tile { values: gpu.upload("tile", &values).expect("fits"), texels, samples }
}

/// A tile like that of [`upload`], the samples masked for which `masked(sample, texel)` says so.
pub fn upload_masked(
    gpu: &Gpu, texels: usize, samples: usize, masked: impl Fn(usize, usize) -> bool, mut value: impl FnMut(usize, usize, usize) -> f64,
) -> Tile {
    upload(gpu, texels, samples, |channel, sample, texel| {
        let value = value(channel, sample, texel);
        if masked(sample, texel) { -1.0 } else { value }
    })
}

/// Whether sample `sample` of texel `texel` is one of about a quarter that tests mask: the same for every tile.
pub fn a_quarter(sample: usize, texel: usize) -> bool {
    Random::new((sample + texel * 1_000_003) as u64).below(4) == 0
}

/// The values of octets `[plane][octet][texel]` as `[plane][sample][texel]`, with the filling after the last sample.
pub fn unpack(octets: &[[f16; OCTET]], texels: usize) -> Vec<f64> {
    let mut values = vec![0.0; octets.len() * OCTET];
    for (index, octet) in octets.iter().enumerate() {
        for (i, half) in octet.iter().enumerate() {
            values[(index / texels * OCTET + i) * texels + index % texels] = f64::from(half.to_f32());
        }
    }
    values
}

/// Random directions, no light beyond 75 degrees.
pub fn directions(random: &mut Random, samples: usize) -> Samples {
    let mut direction = || Direction::from_degrees(random.between(0.0, 75.0), random.between(0.0, 360.0));
    Samples::new((0..samples).map(|_| (direction(), direction())).collect())
}
