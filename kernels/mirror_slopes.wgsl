// Slopes of a surface that goes on mirrored at its right and lower edge, the edge texel doubled: over the seam p changes
// sign with x and q with y. The result is periodic. A mean slope is taken out first. One thread a texel of the result.
// Part of stage frankot_chellappa, twin: reference::frankot_chellappa.
#import thread
#import boundary

struct Params {
    width: u32,
    height: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [row][column] of height x width, (p, q)
@group(0) @binding(1) var<storage, read> slopes: array<vec2<f32>>;
// one value: the mean slope as a sum over all texels, zero to take nothing out
@group(0) @binding(2) var<storage, read> total: array<vec2<f32>>;
// [row][column] of 2·height x 2·width, (p, q)
@group(0) @binding(3) var<storage, read_write> mirrored: array<vec2<f32>>;

const SIZE: u32 = 64u;

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let at = thread_index(group, groups, local, SIZE);
    if at >= 4u * params.width * params.height {
        return;
    }
    let column = at % (2u * params.width);
    let row = at / (2u * params.width);
    let x = wrap(i32(column), params.width, MIRROR);
    let y = wrap(i32(row), params.height, MIRROR);
    let sign = vec2(select(1.0, -1.0, column >= params.width), select(1.0, -1.0, row >= params.height));
    let mean = total[0] / f32(params.width * params.height);
    mirrored[at] = sign * (slopes[y * params.width + x] - mean);
}
