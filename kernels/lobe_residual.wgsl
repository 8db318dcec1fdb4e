// What is left for the next lobe to explain: the mean radiance less what rho_d and the lobes so far give, in the frame of each
// sample's seen normal. 0 where a sample is masked or unlit. One thread an octet of one texel.
// Lafortune et al. 1997; Pati, Rezaiifar, Krishnaprasad 1993 (orthogonal matching pursuit). Twin: reference::lobe_residual.
#import thread
#import octet
#import lafortune
#import shading_frame

struct Params {
    texels: u32,
    octets: u32,
    lobes: u32,
    _pad: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [sample, filled up to octets]
@group(0) @binding(1) var<storage, read> directions: array<SampleDirections>;
// [row][texel], unit normals, w = 0
@group(0) @binding(2) var<storage, read> seen_normals: array<vec4<f32>>;
// [octet][texel], halves: cos theta_i times the share of the light, 0 where masked or unlit
@group(0) @binding(3) var<storage, read> shading: array<vec4<u32>>;
// [octet][texel], halves: mean radiance of the channels, reflectance units
@group(0) @binding(4) var<storage, read> means: array<vec4<u32>>;
// [texel], rho_d of each channel
@group(0) @binding(5) var<storage, read> diffuse: array<vec4<f32>>;
// [lobe][texel], rho_s of each channel
@group(0) @binding(6) var<storage, read> specular: array<vec4<f32>>;
// [lobe][texel], (C_x, C_y, C_z, n)
@group(0) @binding(7) var<storage, read> lobes: array<vec4<f32>>;
// [octet][texel], halves of either sign
@group(0) @binding(8) var<storage, read_write> residual: array<vec4<u32>>;

const SIZE: u32 = 64u;

fn mean(color: vec4<f32>) -> f32 {
    return dot(color.rgb, vec3(1.0 / 3.0));
}

fn reflectance(sample: u32, texel: u32) -> f32 {
    let directions = directions[sample];
    let normal = seen_normals[directions.row * params.texels + texel].xyz;
    let product = product_in_frame(normal, directions.view, directions.light);
    var sum = mean(diffuse[texel]);
    for (var lobe = 0u; lobe < params.lobes; lobe++) {
        let at = lobe * params.texels + texel;
        sum += mean(specular[at]) * lafortune(lobes[at], product);
    }
    return sum;
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let index = thread_index(group, groups, local, SIZE);
    if index >= params.octets * params.texels {
        return;
    }
    let texel = index % params.texels;
    let first = (index / params.texels) * 8u;
    let lit = unpack_octet(shading[index]);
    var left = unpack_octet(means[index]);
    for (var i = 0u; i < 4u; i++) {
        if lit.low[i] > 0.0 {
            left.low[i] -= lit.low[i] * reflectance(first + i, texel);
        }
        if lit.high[i] > 0.0 {
            left.high[i] -= lit.high[i] * reflectance(first + 4u + i, texel);
        }
    }
    residual[index] = pack_octet(left);
}
