// Decodes a tile of 8-bit sRGB images to linear halves: IEC 61966-2-1's curve, one thread an octet of one texel.
// Twin: reference::srgb_decode.
#import thread
#import octet

struct Params {
    texels: u32,
    samples: u32,
    octets: u32,
    _pad: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [sample][texel], red in the lowest byte, alpha ignored
@group(0) @binding(1) var<storage, read> codes: array<u32>;
// [channel][octet][texel], linear radiance in reflectance units; samples past the last are 0
@group(0) @binding(2) var<storage, read_write> radiance: array<vec4<u32>>;

const SIZE: u32 = 64u;

fn linear_from_srgb(code: vec3<f32>) -> vec3<f32> {
    return select(pow((code + 0.055) / 1.055, vec3(2.4)), code / 12.92, code <= vec3(0.04045));
}

fn decode(sample: u32, texel: u32) -> vec3<f32> {
    if sample >= params.samples {
        return vec3(0.0);
    }
    return linear_from_srgb(unpack4x8unorm(codes[sample * params.texels + texel]).rgb);
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let index = thread_index(group, groups, local, SIZE);
    if index >= params.octets * params.texels {
        return;
    }
    let texel = index % params.texels;
    let first = (index / params.texels) * 8u;
    var colours: array<vec3<f32>, 8>;
    for (var i = 0u; i < 8u; i++) {
        colours[i] = decode(first + i, texel);
    }
    for (var channel = 0u; channel < 3u; channel++) {
        let low = vec4(colours[0][channel], colours[1][channel], colours[2][channel], colours[3][channel]);
        let high = vec4(colours[4][channel], colours[5][channel], colours[6][channel], colours[7][channel]);
        radiance[channel * params.octets * params.texels + index] = pack_octet(Octet(low, high));
    }
}
