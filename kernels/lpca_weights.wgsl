// Final weights of each texel in its cluster, by least squares on the samples themselves, and what is left of them: w_c = scale_c sum_d u_cd (x_d - m_d),
// u the duals of the eigenvectors e as they are stored, and the sums of (m + sum_c w_c e_c - x)^2 and x^2 over what is not masked, w rounded as it is
// stored. One thread four members of one cluster. Mueller, Meseth, Klein 2003. Twin: reference::lpca_weights.
#import thread
#import octet
#import deviation

struct Params {
    texels: u32,
    lines: u32,
    members: u32,
    // quads of eigenvectors
    quads: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [line][texel], radiance
@group(0) @binding(1) var<storage, read> radiance: array<vec4<u32>>;
// [member], texel of the tile; four at a time are of one cluster
@group(0) @binding(2) var<storage, read> members: array<u32>;
// [four members], cluster
@group(0) @binding(3) var<storage, read> cluster_of: array<u32>;
// [cluster][line][1 + 4 quads], the mean m and the eigenvectors e
@group(0) @binding(4) var<storage, read> terms: array<vec4<u32>>;
// [cluster][line][4 quads], u
@group(0) @binding(5) var<storage, read> duals: array<vec4<u32>>;
// [cluster][quad]
@group(0) @binding(6) var<storage, read> scales: array<vec4<f32>>;
// [member][quad], w as halves
@group(0) @binding(7) var<storage, read_write> weights: array<vec2<u32>>;
// [member], sums of squared error and of squared radiance
@group(0) @binding(8) var<storage, read_write> errors: array<vec2<f32>>;

const SIZE: u32 = 64u;
// Of MAX_COMPONENTS.
const MAX_QUADS: u32 = 8u;
// Lines summed apart before they join the total, for less rounding.
const BLOCK: u32 = 32u;

fn dot8(a: Octet, b: Octet) -> f32 {
    return dot(a.low, b.low) + dot(a.high, b.high);
}

// Of four duals, what a line adds to a member's weights.
fn weigh(u: array<Octet, 4>, x: Octet) -> vec4<f32> {
    return vec4(dot8(u[0], x), dot8(u[1], x), dot8(u[2], x), dot8(u[3], x));
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let first = 4u * thread_index(group, groups, local, SIZE);
    if first >= params.members {
        return;
    }
    let texels = vec4(members[first], members[first + 1u], members[first + 2u], members[first + 3u]);
    let cluster = cluster_of[first / 4u];
    let term_count = 1u + 4u * params.quads;

    var w: array<mat4x4<f32>, MAX_QUADS>;
    for (var quad = 0u; quad < params.quads; quad++) {
        var total = mat4x4<f32>();
        for (var block = 0u; block < params.lines; block += BLOCK) {
            var part = mat4x4<f32>();
            let end = min(block + BLOCK, params.lines);
            for (var line = block; line < end; line++) {
                let m = unpack_octet(terms[(cluster * params.lines + line) * term_count]);
                let at = ((cluster * params.lines + line) * params.quads + quad) * 4u;
                let u = array<Octet, 4>(unpack_octet(duals[at]), unpack_octet(duals[at + 1u]), unpack_octet(duals[at + 2u]), unpack_octet(duals[at + 3u]));
                let row = line * params.texels;
                part[0] += weigh(u, deviation(radiance[row + texels.x], m));
                part[1] += weigh(u, deviation(radiance[row + texels.y], m));
                part[2] += weigh(u, deviation(radiance[row + texels.z], m));
                part[3] += weigh(u, deviation(radiance[row + texels.w], m));
            }
            total += part;
        }
        let scale = scales[cluster * params.quads + quad];
        for (var i = 0u; i < 4u; i++) {
            let halves = vec2(pack2x16float(scale.xy * total[i].xy), pack2x16float(scale.zw * total[i].zw));
            weights[(first + i) * params.quads + quad] = halves;
            w[quad][i] = vec4(unpack2x16float(halves.x), unpack2x16float(halves.y));
        }
    }

    var squares = mat2x4<f32>();
    for (var block = 0u; block < params.lines; block += BLOCK) {
        var part = mat2x4<f32>();
        let end = min(block + BLOCK, params.lines);
        for (var line = block; line < end; line++) {
            let at = (cluster * params.lines + line) * term_count;
            let m = unpack_octet(terms[at]);
            var r = array<Octet, 4>(m, m, m, m);
            for (var quad = 0u; quad < params.quads; quad++) {
                for (var c = 0u; c < 4u; c++) {
                    let e = unpack_octet(terms[at + 1u + 4u * quad + c]);
                    for (var i = 0u; i < 4u; i++) {
                        r[i].low += w[quad][i][c] * e.low;
                        r[i].high += w[quad][i][c] * e.high;
                    }
                }
            }
            for (var i = 0u; i < 4u; i++) {
                let words = radiance[line * params.texels + texels[i]];
                let error = deviation(words, r[i]);
                let x = deviation(words, Octet(vec4(0.0), vec4(0.0)));
                part[0][i] += dot8(error, error);
                part[1][i] += dot8(x, x);
            }
        }
        squares += part;
    }
    for (var i = 0u; i < 4u; i++) {
        errors[first + i] = vec2(squares[0][i], squares[1][i]);
    }
}
