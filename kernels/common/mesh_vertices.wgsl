// A mesh, whose vertices are looked up by a pass that draws it.

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

@group(0) @binding(14) var<storage, read> vertices: array<Vertex>;
// [triangle][corner]
@group(0) @binding(15) var<storage, read> corners: array<u32>;
