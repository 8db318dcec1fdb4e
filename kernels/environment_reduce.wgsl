// An equirectangular map at another size: each texel the mean of the solid angle that it covers, where the map is as constant over its
// texels as it is stored. So all light stays, and where it came from to within a texel. One thread a texel of some rows of the result.
// Twin: reference::environment.
#import thread

struct Params {
    // columns and rows, before and after
    size: vec2<u32>,
    reduced_size: vec2<u32>,
    // the row that `radiance` starts with
    first_row: u32,
    // rows of the result to be made
    first_reduced: u32,
    reduced_rows: u32,
    _pad: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [row][column][channel], rows from first_row
@group(0) @binding(1) var<storage, read> radiance: array<f32>;
// [row + row of the result], where the two overlap: part of the result's solid angle
@group(0) @binding(2) var<storage, read> row_weights: array<f32>;
// [row][column], linear RGB, w = 0
@group(0) @binding(3) var<storage, read_write> reduced: array<vec4<f32>>;

const SIZE: u32 = 64u;

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let index = thread_index(group, groups, local, SIZE);
    if index >= params.reduced_rows * params.reduced_size.x {
        return;
    }
    // What the texel covers, in parts of which the map has size * reduced_size: whole numbers, below 2^24.
    let texel = vec2(index % params.reduced_size.x, params.first_reduced + index / params.reduced_size.x);
    let low = texel * params.size;
    let high = low + params.size;
    let first = low / params.reduced_size;
    let end = (high + params.reduced_size - 1u) / params.reduced_size;
    var sum = vec3(0.0);
    for (var row = first.y; row < end.y; row++) {
        var row_sum = vec3(0.0);
        for (var column = first.x; column < end.x; column++) {
            let left = max(column * params.reduced_size.x, low.x);
            let right = min((column + 1u) * params.reduced_size.x, high.x);
            let value = 3u * ((row - params.first_row) * params.size.x + column);
            row_sum += f32(right - left) * vec3(radiance[value], radiance[value + 1u], radiance[value + 2u]);
        }
        sum += row_weights[row + texel.y] * row_sum;
    }
    reduced[texel.y * params.reduced_size.x + texel.x] = vec4(sum / f32(params.size.x), 0.0);
}
