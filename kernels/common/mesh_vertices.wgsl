// A mesh in textures, which do not count among a stage's storage buffers.

struct Vertex {
    position: vec3<f32>,
    // texture coordinates in pieces of the material, u right, v up
    u: f32,
    // unit vectors
    normal: vec3<f32>,
    v: f32,
    tangent: vec3<f32>,
    // 1, or -1 where the texture coordinates are mirrored: bitangent = handedness cross(normal, tangent)
    handedness: f32,
}

// [0: position and u, 1: normal and v, 2: tangent and handedness][row][column]
@group(0) @binding(14) var vertices: texture_2d_array<f32>;
// [0][row][column], numbers of the corners of a triangle
@group(0) @binding(15) var corners: texture_2d_array<f32>;

// Where the texel of a number is in rows of so many columns.
fn texel_of(number: u32, columns: u32) -> vec2<u32> {
    return vec2(number % columns, number / columns);
}

// Numbers of a triangle's corners, triangles counted from 0.
fn triangle_corners(triangle: u32) -> vec3<u32> {
    return vec3<u32>(textureLoad(corners, texel_of(triangle, textureDimensions(corners).x), 0, 0).xyz);
}

fn vertex_position(number: u32) -> vec3<f32> {
    return textureLoad(vertices, texel_of(number, textureDimensions(vertices).x), 0, 0).xyz;
}

fn vertex_at(number: u32) -> Vertex {
    let texel = texel_of(number, textureDimensions(vertices).x);
    let position = textureLoad(vertices, texel, 0, 0);
    let normal = textureLoad(vertices, texel, 1, 0);
    let tangent = textureLoad(vertices, texel, 2, 0);
    return Vertex(position.xyz, position.w, normal.xyz, normal.w, tangent.xyz, tangent.w);
}
