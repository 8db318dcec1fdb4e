// The real part of the upper left corner of a complex field. One thread a value of the result.
// Part of stage frankot_chellappa, twin: reference::frankot_chellappa.
#import thread

struct Params {
    width: u32,
    height: u32,
    // columns of the field
    field_width: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [row][column], (real, imaginary), `field_width` columns
@group(0) @binding(1) var<storage, read> field: array<vec2<f32>>;
// [row][column], `width` columns
@group(0) @binding(2) var<storage, read_write> corner: array<f32>;

const SIZE: u32 = 64u;

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let at = thread_index(group, groups, local, SIZE);
    if at >= params.width * params.height {
        return;
    }
    corner[at] = field[at / params.width * params.field_width + at % params.width].x;
}
