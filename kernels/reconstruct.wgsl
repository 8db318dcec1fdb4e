// What the source's camera would have recorded: one pixel a texel on the base plane z = 0, seen orthographically from `view`
// under a directional light, in reflectance units; relief, masking and self-shadow included. One thread a pixel.
// Policarpo et al. 2005; thesis eq. 3.3, 3.9. Twin: reference::reconstruct.
#import thread
#import shade
#import unpainted_svbrdf

// [row][column], RGB in reflectance units, w = 1
@group(0) @binding(12) var<storage, read_write> picture: array<vec4<f32>>;

const SIZE: u32 = 64u;

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    if texel >= scene.width * scene.height {
        return;
    }
    let base = vec2(f32(texel % scene.width), f32(texel / scene.width));
    let view = scene.view.xyz;
    if view.z < MIN_COSINE {
        picture[texel] = vec4(0.0, 0.0, 0.0, 1.0);
        return;
    }
    picture[texel] = vec4(radiance_of(sight_of(base, first_hit(base, view), 0u), view, scene.light.xyz), 1.0);
}
