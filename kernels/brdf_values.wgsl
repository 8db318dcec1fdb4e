// Reflectance from radiance: f = L_o / cos theta_i (thesis eq. 3.5), one thread an octet of one texel and channel.
// Masked samples stay masked. Twin: reference::brdf_values.
#import thread
#import octet

struct Params {
    texels: u32,
    octets: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [octet][2], 1/cos theta_i of each sample, 0 past the last
@group(0) @binding(1) var<storage, read> inverse_cosines: array<vec4<f32>>;
// [channel][octet][texel], radiance in reflectance units, negative where masked
@group(0) @binding(2) var<storage, read> radiance: array<vec4<u32>>;
// [channel][octet][texel], pi times the reflectance, -1 where masked
@group(0) @binding(3) var<storage, read_write> reflectance: array<vec4<u32>>;

const SIZE: u32 = 64u;
// The largest half: a reflectance beyond it is a fault of the measurement and must not become infinite.
const MAX_HALF: vec4<f32> = vec4(65504.0);

fn divide(radiance: vec4<f32>, inverse_cosine: vec4<f32>) -> vec4<f32> {
    return select(min(radiance * inverse_cosine, MAX_HALF), vec4(-1.0), radiance < vec4(0.0));
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let index = thread_index(group, groups, local, SIZE);
    if index >= 3u * params.octets * params.texels {
        return;
    }
    let octet = (index / params.texels) % params.octets;
    var values = unpack_octet(radiance[index]);
    values.low = divide(values.low, inverse_cosines[2u * octet]);
    values.high = divide(values.high, inverse_cosines[2u * octet + 1u]);
    reflectance[index] = pack_octet(values);
}
