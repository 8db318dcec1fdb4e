//! Samples as the stages take them.

use half::f16;

/// `[channel][octet][texel]` of `value(sample, texel)`, the last octet filled up with zeros.
pub fn pack(samples: usize, texels: usize, value: impl Fn(usize, usize) -> [f16; 3]) -> Vec<[f16; 8]> {
    let octets = samples.div_ceil(8);
    let mut packed = vec![[f16::ZERO; 8]; 3 * octets * texels];
    for sample in 0..samples {
        for texel in 0..texels {
            for (channel, value) in value(sample, texel).into_iter().enumerate() {
                packed[(channel * octets + sample / 8) * texels + texel][sample % 8] = value;
            }
        }
    }
    packed
}
