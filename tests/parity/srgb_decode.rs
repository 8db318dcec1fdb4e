use overpaint::{data::OCTET, gpu::Gpu, reference, stage};

use crate::support::{hold, random::Random, tile};

crate::suite! { gpu: agrees_with_its_twin, every_code_decodes, what_follows_the_last_sample_becomes_zero; }

fn decode(gpu: &Gpu, codes: &[u32], samples: usize, texels: usize) -> Vec<f64> {
    let stage = stage::SrgbDecode::new(gpu).expect("builds");
    let mut recorder = gpu.recorder();
    let codes = gpu.upload("codes", codes).expect("fits");
    let decoded = stage.record(&mut recorder, &codes, samples, texels).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    tile::unpack(&decoded.values.read(gpu).expect("reads"), texels)
}

/// Half a unit in the last place of a half where the driver rounds to nearest, one where it truncates (WGSL leaves that open), of
/// a value up to 1: 2^-11; relative, so that dark codes are held as tightly.
const BOUND: f64 = 1.0 / 1024.0;

fn relative(found: f64, expected: f64) -> f64 {
    if expected == 0.0 { found.abs() } else { ((found - expected) / expected).abs() }
}

fn agrees_with_its_twin(gpu: &Gpu) {
    for (samples, texels) in [(1, 1), (7, 63), (8, 64), (9, 65), (81, 5000), (1, 64 * 20_000 + 1)] {
        let mut random = Random::new(3);
        let codes: Vec<u32> = (0..samples * texels).map(|_| random.bits() as u32).collect();
        let found = decode(gpu, &codes, samples, texels);
        let filled = samples.div_ceil(OCTET) * OCTET;
        let mut worst = 0.0_f64;
        for channel in 0..3 {
            for sample in 0..filled {
                for texel in 0..texels {
                    let found = found[(channel * filled + sample) * texels + texel];
                    let expected = if sample < samples {
                        reference::srgb_decode(codes[sample * texels + texel].to_le_bytes()[channel])
                    } else {
                        0.0
                    };
                    worst = if found.is_finite() { worst.max(relative(found, expected)) } else { f64::NAN };
                }
            }
        }
        hold("srgb_decode: relative", worst, BOUND);
    }
}

fn every_code_decodes(gpu: &Gpu) {
    let codes: Vec<u32> = (0..256).map(|code| code * 0x0001_0101).collect();
    let found = decode(gpu, &codes, 1, 256);
    for (code, found) in (0..=255).zip(found) {
        hold("srgb_decode: every code", relative(found, reference::srgb_decode(code)), BOUND);
    }
}

fn what_follows_the_last_sample_becomes_zero(gpu: &Gpu) {
    let found = decode(gpu, &[u32::MAX; 16 * 5], 9, 5);
    assert!(found.iter().enumerate().all(|(index, value)| *value == if index / 5 % 16 < 9 { 1.0 } else { 0.0 }));
}
