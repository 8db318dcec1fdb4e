// One layer of paint raises the surface by its drawn thickness: z + relief x drawn. One thread a texel.
// Twin: reference::paint_relief.
#import thread

struct Params {
    // texel widths where the drawn thickness is 1
    relief: f32,
    texels: u32,
    _pad: vec2<u32>,
}

@group(0) @binding(0) var<uniform> params: Params;
// [texel], texel widths, positive outwards
@group(0) @binding(1) var<storage, read> ground: array<f32>;
// [texel], drawn thickness 0..1
@group(0) @binding(2) var<storage, read> drawn: array<f32>;
// [texel], texel widths, positive outwards
@group(0) @binding(3) var<storage, read_write> heights: array<f32>;

const SIZE: u32 = 64u;

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    if texel >= params.texels {
        return;
    }
    heights[texel] = ground[texel] + params.relief * drawn[texel];
}
