// Turns samples as readers deliver them into octets and masks those that are no radiance: a sample of a texel of which any
// channel is NaN, infinite or negative becomes -1 in all three. One thread an octet of one texel. Twin: reference::gather.
#import thread
#import masked

struct Params {
    texels: u32,
    samples: u32,
    octets: u32,
    _pad: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [sample][channel][texel], linear radiance in reflectance units as halves, two a word, the first of them in its low bits
@group(0) @binding(1) var<storage, read> halves: array<u32>;
// [channel][octet][texel], the same, masked samples -1; samples past the last are 0
@group(0) @binding(2) var<storage, read_write> radiance: array<vec4<u32>>;
// [texel], number of masked samples, 0 before
@group(0) @binding(3) var<storage, read_write> masked: array<atomic<u32>>;

const SIZE: u32 = 64u;
const MINUS_ONE: u32 = 0xbc00u;

fn half_at(index: u32) -> u32 {
    return (halves[index / 2u] >> (16u * (index & 1u))) & 0xffffu;
}

// The channels of a sample, and 1 if it is masked.
fn sample_at(sample: u32, texel: u32) -> vec4<u32> {
    if sample >= params.samples {
        return vec4(0u);
    }
    let red = 3u * sample * params.texels + texel;
    let bits = vec3(half_at(red), half_at(red + params.texels), half_at(red + 2u * params.texels));
    if is_masked(bits) {
        return vec4(vec3(MINUS_ONE), 1u);
    }
    return vec4(bits & vec3(0x7fffu), 0u);
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let index = thread_index(group, groups, local, SIZE);
    let plane = params.octets * params.texels;
    if index >= plane {
        return;
    }
    let texel = index % params.texels;
    let first = (index / params.texels) * 8u;
    // A word of each channel.
    var words: array<vec3<u32>, 4>;
    var count = 0u;
    for (var i = 0u; i < 4u; i++) {
        let low = sample_at(first + 2u * i, texel);
        let high = sample_at(first + 2u * i + 1u, texel);
        words[i] = low.xyz | (high.xyz << vec3(16u));
        count += low.w + high.w;
    }
    for (var channel = 0u; channel < 3u; channel++) {
        radiance[channel * plane + index] = vec4(words[0][channel], words[1][channel], words[2][channel], words[3][channel]);
    }
    if count > 0u {
        atomicAdd(&masked[texel], count);
    }
}
