// Normal and albedo of each texel from its radiance under known lights, the view fixed near the zenith: the least-squares
// solution g of L g = I, with row l of L the direction to light l and I the mean of the three channels; n = g/|g|, albedo = |g|.
// L is shared by all texels, so g = Σ_l I_l·(row l of L's pseudo-inverse, transposed). One thread a texel.
// Rushmeier, Taubin and Guéziec 1997; thesis eq. 3.1, 3.2. Twin: reference::photometric_stereo.
#import thread
#import octet

struct Params {
    texels: u32,
    octets: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [channel][octet][texel], octets of radiance in reflectance units
@group(0) @binding(1) var<storage, read> samples: array<vec4<u32>>;
// [sample], column of (LᵀL)⁻¹Lᵀ in xyz; zeros where an octet is padded
@group(0) @binding(2) var<storage, read> weights: array<vec4<f32>>;
// [texel], unit normal (x right, y up, z out), w = albedo; (0, 0, 1) and 0 where g = 0
@group(0) @binding(3) var<storage, read_write> normals: array<vec4<f32>>;

const SIZE: u32 = 64u;

fn weighted(values: vec4<f32>, first: u32) -> vec3<f32> {
    return values.x * weights[first].xyz + values.y * weights[first + 1u].xyz + values.z * weights[first + 2u].xyz
        + values.w * weights[first + 3u].xyz;
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    if texel >= params.texels {
        return;
    }
    let channel_stride = params.octets * params.texels;
    var g = vec3(0.0);
    for (var octet = 0u; octet < params.octets; octet++) {
        let at = octet * params.texels + texel;
        let red = unpack_octet(samples[at]);
        let green = unpack_octet(samples[at + channel_stride]);
        let blue = unpack_octet(samples[at + 2u * channel_stride]);
        g += weighted((red.low + green.low + blue.low) / 3.0, 8u * octet);
        g += weighted((red.high + green.high + blue.high) / 3.0, 8u * octet + 4u);
    }
    let albedo = length(g);
    if albedo > 0.0 {
        normals[texel] = vec4(g / albedo, albedo);
    } else {
        normals[texel] = vec4(0.0, 0.0, 1.0, 0.0);
    }
}
