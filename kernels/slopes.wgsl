// Slopes p = dz/dx = -n_x/n_z and q = dz/dy = -n_y/n_z of normals. A slope steeper than `max_slope`, or of a normal that
// does not point out (n_z <= 0), keeps its direction and gets the length `max_slope`. One thread a texel.
// Frankot and Chellappa 1988. Twin: reference::frankot_chellappa.
#import thread

struct Params {
    texels: u32,
    max_slope: f32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [texel], normals of any length (x right, y up, z out)
@group(0) @binding(1) var<storage, read> normals: array<vec4<f32>>;
// [texel], (p, q)
@group(0) @binding(2) var<storage, read_write> slopes: array<vec2<f32>>;

const SIZE: u32 = 64u;

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    if texel >= params.texels {
        return;
    }
    let normal = normals[texel].xyz;
    let sideways = length(normal.xy);
    var slope = vec2(0.0);
    if sideways < normal.z * params.max_slope {
        slope = -normal.xy / normal.z;
    } else if sideways > 0.0 {
        slope = -normal.xy * (params.max_slope / sideways);
    }
    slopes[texel] = slope;
}
