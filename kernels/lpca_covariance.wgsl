// Sums of products of the coordinates of each cluster's members about the cluster's last mean: sum_t d_ti d_tj with d = (a - m, 1). The row past the
// coordinates holds the sums of a - m, which tell the new mean, and the number of members. One thread a block of 8 x 8 of one cluster's matrix, upper
// triangle alone. Twin: reference::lpca_covariance.
#import thread

struct Params {
    // octets of coordinates
    rank: u32,
    clusters: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [texel][quad of coordinates], a
@group(0) @binding(1) var<storage, read> coordinates: array<vec4<f32>>;
// [cluster][quad of coordinates], m
@group(0) @binding(2) var<storage, read> means: array<vec4<f32>>;
// [cluster], first of its members and one past the last
@group(0) @binding(3) var<storage, read> ranges: array<vec2<u32>>;
// [member], texel
@group(0) @binding(4) var<storage, read> members: array<u32>;
// [cluster][row][quad of columns], rows and columns eight more than coordinates
@group(0) @binding(5) var<storage, read_write> products: array<vec4<f32>>;

const SIZE: u32 = 64u;
// Members summed apart before they join the total, for less rounding.
const BLOCK: u32 = 64u;

// Eight of a member's d.
struct Eight {
    low: vec4<f32>,
    high: vec4<f32>,
}

fn eight_of(texel: u32, cluster: u32, octet: u32) -> Eight {
    if octet == params.rank {
        return Eight(vec4(1.0, 0.0, 0.0, 0.0), vec4(0.0));
    }
    let a = 2u * (texel * params.rank + octet);
    let m = 2u * (cluster * params.rank + octet);
    return Eight(coordinates[a] - means[m], coordinates[a + 1u] - means[m + 1u]);
}

// Four rows by eight columns of a block.
struct Rows {
    low: mat4x4<f32>,
    high: mat4x4<f32>,
}

fn add_products(rows: ptr<function, Rows>, left: vec4<f32>, right: Eight) {
    (*rows).low[0] += left.x * right.low;
    (*rows).low[1] += left.y * right.low;
    (*rows).low[2] += left.z * right.low;
    (*rows).low[3] += left.w * right.low;
    (*rows).high[0] += left.x * right.high;
    (*rows).high[1] += left.y * right.high;
    (*rows).high[2] += left.z * right.high;
    (*rows).high[3] += left.w * right.high;
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let block = thread_index(group, groups, local, SIZE);
    let octets = params.rank + 1u;
    let row = block / octets;
    let column = block % octets;
    if row >= octets || column < row {
        return;
    }
    let cluster = group.z;
    let range = ranges[cluster];
    var top: Rows;
    var bottom: Rows;
    for (var start = range.x; start < range.y; start += BLOCK) {
        var top_part: Rows;
        var bottom_part: Rows;
        let end = min(start + BLOCK, range.y);
        for (var member = start; member < end; member++) {
            let texel = members[member];
            let left = eight_of(texel, cluster, row);
            let right = eight_of(texel, cluster, column);
            add_products(&top_part, left.low, right);
            add_products(&bottom_part, left.high, right);
        }
        top.low += top_part.low;
        top.high += top_part.high;
        bottom.low += bottom_part.low;
        bottom.high += bottom_part.high;
    }
    for (var i = 0u; i < 4u; i++) {
        let upper = ((cluster * octets + row) * 8u + i) * octets * 2u + 2u * column;
        products[upper] = top.low[i];
        products[upper + 1u] = top.high[i];
        let lower = upper + 8u * octets;
        products[lower] = bottom.low[i];
        products[lower + 1u] = bottom.high[i];
    }
}
