// Terms of a compressed BTF under one view and light: each interpolated between nine measured pairs once, for all texels of a picture.
// One thread a term of a cluster. Mueller, Meseth, Klein 2003. Twin: reference::reconstruct_lpca.
#import thread
#import lpca

struct Directions {
    // unit vectors that point away from the surface, x right, y up, z out; w = 0
    view: vec4<f32>,
    light: vec4<f32>,
}

@group(0) @binding(0) var<uniform> seen: Directions;
// [cluster][term], RGB in reflectance units, w = 0
@group(0) @binding(1) var<storage, read_write> blended: array<vec4<f32>>;

const SIZE: u32 = 64u;

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let index = thread_index(group, groups, local, SIZE);
    if index >= btf.clusters * (1u + btf.components) {
        return;
    }
    var pairs = measured_pairs(seen.view.xyz, seen.light.xyz);
    blended[index] = vec4(term_of(&pairs, index / (1u + btf.components), index % (1u + btf.components)), 0.0);
}
