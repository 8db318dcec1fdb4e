// Lifts what is known of each cluster's texels by their weights to their samples: adds sum_t w_t (x_td - c_d) over the cluster's members in this
// tile, for four kinds of weights, and how many of the members' samples are not masked. With w the coordinates of the members about their mean
// along eigenvectors, the sums are those eigenvectors times the variance of w, what the coordinates' basis leaves out of them included.
// One thread a line of one cluster. Mueller, Meseth, Klein 2003; Halko, Martinsson, Tropp 2011, section 4.5. Twin: reference::lpca_lift.
#import thread
#import octet
#import deviation

struct Params {
    texels: u32,
    lines: u32,
    // quads of weights of a member, and which of them
    quads: u32,
    quad: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [line][texel], radiance
@group(0) @binding(1) var<storage, read> radiance: array<vec4<u32>>;
// [line], c
@group(0) @binding(2) var<storage, read> centre: array<Octet>;
// [cluster], first of its members and one past the last
@group(0) @binding(3) var<storage, read> ranges: array<vec2<u32>>;
// [member], texel of the tile
@group(0) @binding(4) var<storage, read> members: array<u32>;
// [member][quad], w
@group(0) @binding(5) var<storage, read> weights: array<vec4<f32>>;
// [cluster][weight of the quad][line], added to
@group(0) @binding(6) var<storage, read_write> sums: array<Octet>;
// [cluster][line], added to
@group(0) @binding(7) var<storage, read_write> counts: array<Octet>;

const SIZE: u32 = 64u;
// Members summed apart before they join the total, for less rounding.
const BLOCK: u32 = 64u;

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let line = thread_index(group, groups, local, SIZE);
    if line >= params.lines {
        return;
    }
    let cluster = group.z;
    let range = ranges[cluster];
    let c = centre[line];
    // Rows: the weights.
    var low = mat4x4<f32>();
    var high = mat4x4<f32>();
    var count = Octet(vec4(0.0), vec4(0.0));
    for (var block = range.x; block < range.y; block += BLOCK) {
        var low_part = mat4x4<f32>();
        var high_part = mat4x4<f32>();
        let end = min(block + BLOCK, range.y);
        for (var member = block; member < end; member++) {
            let words = radiance[line * params.texels + members[member]];
            let x = deviation(words, c);
            let w = weights[member * params.quads + params.quad];
            low_part[0] += w.x * x.low;
            low_part[1] += w.y * x.low;
            low_part[2] += w.z * x.low;
            low_part[3] += w.w * x.low;
            high_part[0] += w.x * x.high;
            high_part[1] += w.y * x.high;
            high_part[2] += w.z * x.high;
            high_part[3] += w.w * x.high;
            let is_valid = valid(words);
            count.low += is_valid.low;
            count.high += is_valid.high;
        }
        low += low_part;
        high += high_part;
    }
    for (var i = 0u; i < 4u; i++) {
        let at = (cluster * 4u + i) * params.lines + line;
        sums[at].low += low[i];
        sums[at].high += high[i];
    }
    let at = cluster * params.lines + line;
    counts[at].low += count.low;
    counts[at].high += count.high;
}
