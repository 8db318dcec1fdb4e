use half::f16;
use overpaint::{data::OCTET, gpu::Gpu, model::FitSettings, reference, stage};

use crate::support::{random::Random, tile};

crate::suite! { gpu: agrees_with_its_twin; }

/// The octets of a tile and of what is left of it.
pub fn lit(gpu: &Gpu, reflectance: &stage::Tile, median: &[[f32; 4]], fraction: f64) -> [Vec<[f16; OCTET]>; 2] {
    let stage = stage::DarkSamples::new(gpu).expect("builds");
    let settings = FitSettings { dark_fraction: fraction, ..FitSettings::default() };
    let median = gpu.upload("median", median).expect("fits");
    let mut recorder = gpu.recorder();
    let lit = stage.record(&mut recorder, reflectance, &median, &settings).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    assert_eq!((lit.texels, lit.samples), (reflectance.texels, reflectance.samples));
    [reflectance, &lit].map(|tile| tile.values.read(gpu).expect("reads"))
}

fn agrees_with_its_twin(gpu: &Gpu) {
    for (samples, texels) in [(1, 1), (7, 63), (8, 64), (9, 65), (81, 500), (1, 64 * 20_000 + 1)] {
        for fraction in [0.0, 0.2, 1.0] {
            let mut random = Random::new(97);
            let reflectance = tile::upload_masked(gpu, texels, samples, tile::a_quarter, |_, _, _| random.unit());
            let median: Vec<[f32; 4]> = (0..texels).map(|_| [0; 4].map(|_| 0.3 + random.unit() as f32)).collect();
            let [given, found] = lit(gpu, &reflectance, &median, fraction);
            let settings = FitSettings { dark_fraction: fraction, ..FitSettings::default() };
            let plane = given.len() / 3;
            let mut ties = 0;
            for index in 0..plane * OCTET {
                let (at, i) = (index / OCTET, index % OCTET);
                let f = [0, 1, 2].map(|channel| given[channel * plane + at][i].to_f64());
                let of_texel = [0, 1, 2].map(|channel| f64::from(median[at % texels][channel]));
                let is_sample = at / texels * OCTET + i < samples;
                // The kernel's sums of three are rounded to single precision.
                let distance = f.iter().sum::<f64>() - fraction * of_texel.iter().sum::<f64>();
                if is_sample && f[0] >= 0.0 && fraction > 0.0 && distance.abs() < 1e-6 {
                    ties += 1;
                    continue;
                }
                let masked = is_sample && reference::dark_samples(f, of_texel, &settings);
                for channel in 0..3 {
                    let expected = if masked { f16::NEG_ONE } else { given[channel * plane + at][i] };
                    assert_eq!(found[channel * plane + at][i].to_bits(), expected.to_bits(), "sample {i} of octet {at}, fraction {fraction}");
                }
            }
            assert!(ties <= 1 + plane / 10_000, "{ties} samples on the bound");
        }
    }
}
