use half::f16;
use overpaint::{data::OCTET, gpu::Gpu, reference, stage};

use crate::support::{random::Random, tile};

crate::suite! { gpu: agrees_with_its_twin; }

/// The tile's values `[channel][sample][texel]` with the filling after the last sample, and the number of each texel's masked samples,
/// of `halves` `[sample][channel][texel]`. A half that fills up the last word is no radiance.
pub fn gather(gpu: &Gpu, halves: &[u16], samples: usize, texels: usize) -> (Vec<f64>, Vec<u32>) {
    assert_eq!(halves.len(), 3 * samples * texels);
    let words: Vec<u32> = halves.chunks(2).map(|pair| u32::from(pair[0]) | u32::from(*pair.get(1).unwrap_or(&0xffff)) << 16).collect();
    let stage = stage::Gather::new(gpu).expect("builds");
    let mut recorder = gpu.recorder();
    let halves = gpu.upload("halves", &words).expect("fits");
    let gathered = stage.record(&mut recorder, &halves, samples, texels).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    let values = tile::unpack(&gathered.tile.values.read(gpu).expect("reads"), texels);
    (values, gathered.masked.read(gpu).expect("reads"))
}

/// The same bits, from few texels with very many samples to many texels with one.
fn agrees_with_its_twin(gpu: &Gpu) {
    for (samples, texels) in [(1, 1), (7, 63), (8, 64), (9, 65), (81, 500), (22_801, 3), (1, 64 * 20_000 + 1)] {
        let mut random = Random::new(89);
        // A tenth of all halves is any pattern, so nearly every second one of these no radiance.
        let half = |random: &mut Random| if random.below(10) == 0 { random.bits() as u16 } else { random.below(0x7c00) as u16 };
        let halves: Vec<u16> = (0..3 * samples * texels).map(|_| half(&mut random)).collect();
        let (found, masked) = gather(gpu, &halves, samples, texels);
        let filled = samples.next_multiple_of(OCTET);
        assert_eq!((found.len(), masked.len()), (3 * filled * texels, texels));
        let mut expected_masked = vec![0; texels];
        for sample in 0..filled {
            for texel in 0..texels {
                let half = |channel: usize| f16::from_bits(halves[(3 * sample + channel) * texels + texel]);
                let expected = if sample < samples { reference::gather([0, 1, 2].map(half)) } else { [0.0; 3] };
                expected_masked[texel] += u32::from(expected[0] < 0.0);
                let found = [0, 1, 2].map(|channel| found[(channel * filled + sample) * texels + texel]);
                assert_eq!(found.map(f64::to_bits), expected.map(f64::to_bits), "sample {sample} of texel {texel}: {found:?}");
            }
        }
        assert!(masked == expected_masked, "{samples} samples of {texels} texels");
    }
}
