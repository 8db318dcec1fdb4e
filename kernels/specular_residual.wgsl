// What the lobe is fitted to: the plain mean over the channels of max(f - rho_d, 0) (thesis section 3.2.2, steps 3, 4).
// Masked samples stay masked. One thread an octet of one texel. Twin: reference::specular_residual.
#import thread
#import octet

struct Params {
    texels: u32,
    octets: u32,
    samples: u32,
    _pad: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [channel][octet][texel], pi times the reflectance, negative where masked
@group(0) @binding(1) var<storage, read> reflectance: array<vec4<u32>>;
// [texel], rho_d of each channel
@group(0) @binding(2) var<storage, read> diffuse: array<vec4<f32>>;
// [octet][texel], mean specular residual, -1 where masked; samples past the last are 0
@group(0) @binding(3) var<storage, read_write> residual: array<vec4<u32>>;

const SIZE: u32 = 64u;
// The mean of the largest halves is no larger, but for rounding.
const MAX_HALF: vec4<f32> = vec4(65504.0);

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let index = thread_index(group, groups, local, SIZE);
    let plane = params.octets * params.texels;
    if index >= plane {
        return;
    }
    let rho = diffuse[index % params.texels];
    var mean = Octet(vec4(0.0), vec4(0.0));
    var least = mean;
    for (var channel = 0u; channel < 3u; channel++) {
        let values = unpack_octet(reflectance[channel * plane + index]);
        mean.low += max(values.low - rho[channel], vec4(0.0)) / 3.0;
        mean.high += max(values.high - rho[channel], vec4(0.0)) / 3.0;
        least.low = min(least.low, values.low);
        least.high = min(least.high, values.high);
    }
    mean.low = select(min(mean.low, MAX_HALF), vec4(-1.0), least.low < vec4(0.0));
    mean.high = select(min(mean.high, MAX_HALF), vec4(-1.0), least.high < vec4(0.0));
    let first = (index / params.texels) * 8u;
    let sample = vec4(first) + vec4(0u, 1u, 2u, 3u);
    mean.low = select(vec4(0.0), mean.low, sample < vec4(params.samples));
    mean.high = select(vec4(0.0), mean.high, sample + 4u < vec4(params.samples));
    residual[index] = pack_octet(mean);
}
