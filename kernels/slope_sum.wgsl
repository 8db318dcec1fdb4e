// Sum of each row of slopes, in a fixed order: every thread adds up its columns, then the threads' sums fold in halves.
// One workgroup a row, a row in each workgroup_id.z. Part of stage frankot_chellappa, twin: reference::frankot_chellappa.

struct Params {
    columns: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [row][column], (p, q)
@group(0) @binding(1) var<storage, read> slopes: array<vec2<f32>>;
// [row], (p, q) summed over the columns
@group(0) @binding(2) var<storage, read_write> sums: array<vec2<f32>>;

const SIZE: u32 = 64u;

var<workgroup> partial: array<vec2<f32>, SIZE>;

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let row = group.z;
    var sum = vec2(0.0);
    for (var column = local; column < params.columns; column += SIZE) {
        sum += slopes[row * params.columns + column];
    }
    partial[local] = sum;
    for (var half = SIZE / 2u; half > 0u; half /= 2u) {
        workgroupBarrier();
        if local < half {
            partial[local] += partial[local + half];
        }
    }
    if local == 0u {
        sums[row] = partial[0];
    }
}
