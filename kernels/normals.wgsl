// Normals of a height field: n = (-p, -q, 1)/|(-p, -q, 1)| with slopes p = dz/dx, q = dz/dy by central differences.
// Image rows run downwards and y upwards, hence the sign of q. One thread a texel.
// Twin: reference::normals.
#import thread
#import boundary

struct Params {
    width: u32,
    height: u32,
    boundary: u32,
    _pad: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [row][column], texel widths, positive outwards
@group(0) @binding(1) var<storage, read> heights: array<f32>;
// [row][column], unit vectors (x right, y up, z out), w = 0
@group(0) @binding(2) var<storage, read_write> normals: array<vec4<f32>>;

const SIZE: u32 = 64u;

fn height_at(column: i32, row: i32) -> f32 {
    let x = wrap(column, params.width, params.boundary);
    let y = wrap(row, params.height, params.boundary);
    return heights[y * params.width + x];
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    if texel >= params.width * params.height {
        return;
    }
    let column = i32(texel % params.width);
    let row = i32(texel / params.width);
    let p = 0.5 * (height_at(column + 1, row) - height_at(column - 1, row));
    let q = 0.5 * (height_at(column, row - 1) - height_at(column, row + 1));
    normals[texel] = vec4(normalize(vec3(-p, -q, 1.0)), 0.0);
}
