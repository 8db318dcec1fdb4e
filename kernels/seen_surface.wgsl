// What the views see of a height field at some texels' places on the base plane: the point that a view's ray meets, and the
// field's normal there. One thread a texel and view.
// Policarpo et al. 2005. Twin: reference::seen_surface.
#import thread
#import relief

struct Params {
    texels: u32,
    views: u32,
}

@group(0) @binding(3) var<uniform> params: Params;
// [view], unit vectors that point away from the surface, w = 0
@group(0) @binding(4) var<storage, read> views: array<vec4<f32>>;
// [texel], (column, row)
@group(0) @binding(5) var<storage, read> places: array<vec2<u32>>;
// [view][texel], unit normals, w = 0
@group(0) @binding(6) var<storage, read_write> seen_normals: array<vec4<f32>>;
// [view][texel], column, row and height of the point seen, texels and texel widths; w = 0
@group(0) @binding(7) var<storage, read_write> points: array<vec4<f32>>;

const SIZE: u32 = 64u;

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let index = thread_index(group, groups, local, SIZE);
    if index >= params.views * params.texels {
        return;
    }
    let base = vec2<f32>(places[index % params.texels]);
    let view = views[index / params.texels].xyz;
    var hit = Hit(base, height_at(base));
    if view.z >= MIN_COSINE {
        hit = first_hit(base, view);
    }
    seen_normals[index] = vec4(normal_at(hit.place), 0.0);
    points[index] = vec4(hit.place, hit.height, 0.0);
}
