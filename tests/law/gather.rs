use half::f16;
use overpaint::gpu::Gpu;

use crate::{parity::gather::gather, support::random::Random};

crate::suite! { gpu: every_pattern_is_kept_or_masked, what_is_gathered_stays, all_may_be_masked; }

/// Each of the 65,536 halves in each channel beside two sound ones: 0 to 0x7bff and −0, which becomes 0, are radiance.
fn every_pattern_is_kept_or_masked(gpu: &Gpu) {
    let texels = 1 << 16;
    let sound = [0x3c01, 0x0001, 0x7bff];
    let halves: Vec<u16> = (0..3 * 3 * texels)
        .map(|index| match (index / texels / 3, index / texels % 3) {
            (sample, channel) if sample == channel => (index % texels) as u16,
            (_, channel) => sound[channel],
        })
        .collect();
    let (found, masked) = gather(gpu, &halves, 3, texels);
    for pattern in 0..texels {
        let bits = pattern as u16;
        let kept = bits <= 0x7bff || bits == 0x8000;
        assert_eq!(masked[pattern], if kept { 0 } else { 3 }, "{bits:#x}");
        for sample in 0..3 {
            for channel in 0..3 {
                let value = found[(channel * 8 + sample) * texels + pattern];
                let expected = match (kept, sample == channel) {
                    (false, _) => 0xbc00,
                    (true, true) => bits & 0x7fff,
                    (true, false) => sound[channel],
                };
                assert_eq!(f16::from_f64(value).to_bits(), expected, "{bits:#x}");
            }
        }
    }
}

/// A tile's samples gathered again are the same, and as many are masked.
fn what_is_gathered_stays(gpu: &Gpu) {
    let (samples, texels) = (13, 70);
    let mut random = Random::new(97);
    let halves: Vec<u16> = (0..3 * samples * texels).map(|_| random.bits() as u16).collect();
    let once = gather(gpu, &halves, samples, texels);
    let mut again = halves;
    for (index, half) in again.iter_mut().enumerate() {
        let (sample, channel) = (index / texels / 3, index / texels % 3);
        *half = f16::from_f64(once.0[(channel * 16 + sample) * texels + index % texels]).to_bits();
    }
    assert!(once.1.iter().any(|masked| *masked > 0));
    assert!(gather(gpu, &again, samples, texels) == once);
}

/// Every sample of few texels with very many.
fn all_may_be_masked(gpu: &Gpu) {
    let (samples, texels) = (22_801, 2);
    let (found, masked) = gather(gpu, &vec![0xfe00; 3 * samples * texels], samples, texels);
    assert_eq!(masked, [22_801; 2]);
    let filled = samples.next_multiple_of(8);
    assert!(found.iter().enumerate().all(|(index, value)| *value == if index / texels % filled < samples { -1.0 } else { 0.0 }));
}
