use overpaint::{data::OCTET, gpu::Gpu, reference, stage};

use crate::support::{Worst, hold, random::Random, tile};

crate::suite! { gpu: agrees_with_its_twin, every_code_decodes; }

/// Linear radiance `[channel][sample][texel]`, with the filling after the last sample.
pub fn decode(gpu: &Gpu, codes: &[u32], samples: usize, texels: usize) -> Vec<f64> {
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
        assert_eq!(found.len(), 3 * filled * texels);
        let errors = found.iter().enumerate().map(|(index, &found)| {
            let (channel, sample, texel) = (index / texels / filled, index / texels % filled, index % texels);
            let code = codes.get(sample * texels + texel).map(|code| code.to_le_bytes()[channel]);
            relative(found, code.map_or(0.0, reference::srgb_decode))
        });
        hold("srgb_decode: relative", errors.worst(), BOUND);
    }
}

fn every_code_decodes(gpu: &Gpu) {
    let codes: Vec<u32> = (0..256).map(|code| code * 0x0001_0101).collect();
    let found = decode(gpu, &codes, 1, 256);
    for (code, found) in (0..=255).zip(found) {
        hold("srgb_decode: every code", relative(found, reference::srgb_decode(code)), BOUND);
    }
}
