// Coordinates of each texel's samples in a basis: a_j = scale sum_d (x_d - c_d) b_jd, and the energy sum_d s_d (x_d - c_d)^2 that they have
// about the centre c. A masked sample counts as the centre. One thread four texels, a workgroup apart, and sixteen vectors.
// Mueller, Meseth, Klein 2003; Halko, Martinsson, Tropp 2011, alg. 4.1. Twin: reference::lpca_project.
#import thread
#import octet
#import deviation

struct Params {
    texels: u32,
    // octets of all three channels
    lines: u32,
    // sixteens of vectors
    blocks: u32,
    scale: f32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [line][texel], radiance
@group(0) @binding(1) var<storage, read> radiance: array<vec4<u32>>;
// [line], eight c and eight s
@group(0) @binding(2) var<storage, read> centre: array<Octet>;
@group(0) @binding(3) var<storage, read> energy_weights: array<Octet>;
// [line][vector], b
@group(0) @binding(4) var<storage, read> basis: array<vec4<u32>>;
// [texel][quad of vectors], a
@group(0) @binding(5) var<storage, read_write> coordinates: array<vec4<f32>>;
// [texel]
@group(0) @binding(6) var<storage, read_write> energies: array<f32>;

const SIZE: u32 = 64u;
const TEXELS: u32 = 4u;
const VECTORS: u32 = 16u;

// A value of each of the thread's texels.
alias Four = vec4<f32>;

// What one vector's octet adds.
fn product(x: array<Four, 8>, at: u32) -> Four {
    let b = unpack_octet(basis[at]);
    return x[0] * b.low.x + x[1] * b.low.y + x[2] * b.low.z + x[3] * b.low.w
        + x[4] * b.high.x + x[5] * b.high.y + x[6] * b.high.z + x[7] * b.high.w;
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let first = (group.y * groups.x + group.x) * SIZE * TEXELS + local;
    let block = group.z;
    if first >= params.texels {
        return;
    }
    // Past the last texel it is read again, and not written.
    let texels = min(first + SIZE * vec4(0u, 1u, 2u, 3u), vec4(params.texels - 1u));
    var energy = Four(0.0);
    var a0 = Four(0.0);
    var a1 = Four(0.0);
    var a2 = Four(0.0);
    var a3 = Four(0.0);
    var a4 = Four(0.0);
    var a5 = Four(0.0);
    var a6 = Four(0.0);
    var a7 = Four(0.0);
    var a8 = Four(0.0);
    var a9 = Four(0.0);
    var a10 = Four(0.0);
    var a11 = Four(0.0);
    var a12 = Four(0.0);
    var a13 = Four(0.0);
    var a14 = Four(0.0);
    var a15 = Four(0.0);
    for (var line = 0u; line < params.lines; line++) {
        let c = centre[line];
        let row = line * params.texels;
        let d0 = deviation(radiance[row + texels.x], c);
        let d1 = deviation(radiance[row + texels.y], c);
        let d2 = deviation(radiance[row + texels.z], c);
        let d3 = deviation(radiance[row + texels.w], c);
        let low = transpose(mat4x4(d0.low, d1.low, d2.low, d3.low));
        let high = transpose(mat4x4(d0.high, d1.high, d2.high, d3.high));
        let x = array<Four, 8>(low[0], low[1], low[2], low[3], high[0], high[1], high[2], high[3]);
        if block == 0u {
            let s = energy_weights[line];
            energy += Four(
                dot(d0.low * d0.low, s.low) + dot(d0.high * d0.high, s.high),
                dot(d1.low * d1.low, s.low) + dot(d1.high * d1.high, s.high),
                dot(d2.low * d2.low, s.low) + dot(d2.high * d2.high, s.high),
                dot(d3.low * d3.low, s.low) + dot(d3.high * d3.high, s.high),
            );
        }
        let at = (line * params.blocks + block) * VECTORS;
        a0 += product(x, at);
        a1 += product(x, at + 1u);
        a2 += product(x, at + 2u);
        a3 += product(x, at + 3u);
        a4 += product(x, at + 4u);
        a5 += product(x, at + 5u);
        a6 += product(x, at + 6u);
        a7 += product(x, at + 7u);
        a8 += product(x, at + 8u);
        a9 += product(x, at + 9u);
        a10 += product(x, at + 10u);
        a11 += product(x, at + 11u);
        a12 += product(x, at + 12u);
        a13 += product(x, at + 13u);
        a14 += product(x, at + 14u);
        a15 += product(x, at + 15u);
    }
    let q0 = transpose(mat4x4(a0, a1, a2, a3));
    let q1 = transpose(mat4x4(a4, a5, a6, a7));
    let q2 = transpose(mat4x4(a8, a9, a10, a11));
    let q3 = transpose(mat4x4(a12, a13, a14, a15));
    for (var i = 0u; i < TEXELS; i++) {
        if first + i * SIZE >= params.texels {
            return;
        }
        let texel = first + i * SIZE;
        let at = (texel * params.blocks + block) * (VECTORS / 4u);
        coordinates[at] = params.scale * q0[i];
        coordinates[at + 1u] = params.scale * q1[i];
        coordinates[at + 2u] = params.scale * q2[i];
        coordinates[at + 3u] = params.scale * q3[i];
        if block == 0u {
            energies[texel] = energy[i];
        }
    }
}
