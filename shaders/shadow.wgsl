// Depth of a mesh as a light sees it (Williams 1978). There is no fragment stage.
#import mesh_vertices

struct Shadow {
    // rows of the matrix from world to clip coordinates
    clip_x: vec4<f32>,
    clip_y: vec4<f32>,
    clip_z: vec4<f32>,
    clip_w: vec4<f32>,
}

@group(0) @binding(12) var<uniform> shadow: Shadow;

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    let p = vec4(vertex_position(triangle_corners(index / 3u)[index % 3u]), 1.0);
    return vec4(dot(shadow.clip_x, p), dot(shadow.clip_y, p), dot(shadow.clip_z, p), dot(shadow.clip_w, p));
}
