// How far a texel's reflectance in the frames of its normals is from what was measured: over the samples that are not masked and the
// channels, the sums of (model - L)^2, L^2, model - L and L, with model = c (rho_d + sum_j rho_s,j m_j), c the shading and m_j lobe j
// in the frame of the sample's normal. One thread a texel. Twin: reference::radiance_error.
#import thread
#import octet
#import local_samples

struct Params {
    texels: u32,
    octets: u32,
    lobes: u32,
    _pad: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [texel], rho_d of each channel
@group(0) @binding(6) var<storage, read> diffuse: array<vec4<f32>>;
// [lobe][texel], rho_s of each channel
@group(0) @binding(7) var<storage, read> specular: array<vec4<f32>>;
// [texel], sums of (model - L)^2, L^2, model - L, L
@group(0) @binding(8) var<storage, read_write> errors: array<vec4<f32>>;

const SIZE: u32 = 64u;
// Octets summed apart before they join the total, for less rounding.
const BLOCK: u32 = 32u;

// What is known of a texel.
struct Reflectance {
    diffuse: vec3<f32>,
    specular: array<vec3<f32>, MAX_LOBES>,
    lobes: array<vec4<f32>, MAX_LOBES>,
}

fn reflectance_of(texel: u32) -> Reflectance {
    var own: Reflectance;
    own.diffuse = diffuse[texel].rgb;
    own.lobes = lobes_of(texel, params.texels, params.lobes);
    for (var lobe = 0u; lobe < params.lobes; lobe++) {
        own.specular[lobe] = specular[lobe * params.texels + texel].rgb;
    }
    return own;
}

fn error_at(sample: u32, texel: u32, own: Reflectance, c: f32, rgb: vec3<f32>) -> vec4<f32> {
    if any(rgb < vec3(0.0)) {
        return vec4(0.0);
    }
    var model = vec3(0.0);
    if c > 0.0 {
        let m = lobes_at(sample, texel, params.texels, own.lobes);
        model = c * (own.diffuse + own.specular[0] * m.x + own.specular[1] * m.y + own.specular[2] * m.z);
    }
    let error = model - rgb;
    return vec4(dot(error, error), dot(rgb, rgb), error.r + error.g + error.b, rgb.r + rgb.g + rgb.b);
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    if texel >= params.texels {
        return;
    }
    let own = reflectance_of(texel);
    let plane = params.octets * params.texels;
    var total = vec4(0.0);
    for (var block = 0u; block < params.octets; block += BLOCK) {
        var part = vec4(0.0);
        let end = min(block + BLOCK, params.octets);
        for (var octet = block; octet < end; octet++) {
            let at = octet * params.texels + texel;
            let c = unpack_octet(shading[at]);
            let red = unpack_octet(radiance[at]);
            let green = unpack_octet(radiance[plane + at]);
            let blue = unpack_octet(radiance[2u * plane + at]);
            let first = octet * 8u;
            for (var i = 0u; i < 4u; i++) {
                part += error_at(first + i, texel, own, c.low[i], vec3(red.low[i], green.low[i], blue.low[i]));
                part += error_at(first + 4u + i, texel, own, c.high[i], vec3(red.high[i], green.high[i], blue.high[i]));
            }
        }
        total += part;
    }
    errors[texel] = total;
}
