// An image reduced to fewer pixels, each the mean of the area that it covers. One thread a pixel of the result.
// Twin: reference::pattern_image.
#import thread

struct Params {
    // columns and rows: before, and after
    size: vec2<u32>,
    reduced_size: vec2<u32>,
    // pixels of the first in one of the result, rounded up
    factor: vec2<u32>,
}

@group(0) @binding(0) var<uniform> params: Params;
// [row][column], drawn thickness 0..1
@group(0) @binding(1) var<storage, read> image: array<f32>;
// [row][column], the same
@group(0) @binding(2) var<storage, read_write> reduced: array<f32>;

const SIZE: u32 = 64u;

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let index = thread_index(group, groups, local, SIZE);
    if index >= params.reduced_size.x * params.reduced_size.y {
        return;
    }
    let pixel = vec2(index % params.reduced_size.x, index / params.reduced_size.x);
    // The result's pixels are a little smaller than `factor` of the image's, so that whole ones fill its edges; they begin and end
    // that little before the multiples of `factor`, in pixels of the image counted from the multiple before.
    let missing = params.factor * params.reduced_size - params.size;
    let start = pixel * params.factor;
    let low = -vec2<f32>(pixel * missing) / vec2<f32>(params.reduced_size);
    let high = vec2<f32>(params.factor) - vec2<f32>((pixel + 1u) * missing) / vec2<f32>(params.reduced_size);
    let first = vec2<i32>(floor(low));
    let end = vec2<i32>(ceil(high));
    var sum = 0.0;
    for (var row = first.y; row < end.y; row++) {
        var row_sum = 0.0;
        for (var column = first.x; column < end.x; column++) {
            let width = min(f32(column) + 1.0, high.x) - max(f32(column), low.x);
            row_sum += width * image[u32(i32(start.y) + row) * params.size.x + u32(i32(start.x) + column)];
        }
        sum += (min(f32(row) + 1.0, high.y) - max(f32(row), low.y)) * row_sum;
    }
    let covered = vec2<f32>(params.size) / vec2<f32>(params.reduced_size);
    reduced[index] = sum / (covered.x * covered.y);
}
