// One more picture of a mean: sum + weight x picture, whose rows are padded. One thread a pixel. Twin: reference::average.
#import thread

struct Params {
    width: u32,
    pixels: u32,
    // pixels of a padded row
    stride: u32,
    // 1 for the first picture
    first: u32,
    weight: f32,
    _pad0: u32,
    _pad1: u32,
    _pad2: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [row][column], rows padded
@group(0) @binding(1) var<storage, read> picture: array<vec4<f32>>;
// [row][column]
@group(0) @binding(2) var<storage, read_write> mean: array<vec4<f32>>;

const SIZE: u32 = 64u;

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let pixel = thread_index(group, groups, local, SIZE);
    if pixel >= params.pixels {
        return;
    }
    let value = params.weight * picture[pixel / params.width * params.stride + pixel % params.width];
    if params.first == 1u {
        mean[pixel] = value;
    } else {
        mean[pixel] += value;
    }
}
