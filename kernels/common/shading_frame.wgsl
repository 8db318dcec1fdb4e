// The frame of a unit normal n with n_z > 0, in which a texel's lobes stand: the base plane's turned by the shortest way from z
// to n. Twin: model::in_frame.

// One sample of a tile.
struct SampleDirections {
    // unit vectors that point away from the surface, in the base plane's frame
    view: vec3<f32>,
    // row of the seen normals that is this view's
    row: u32,
    light: vec3<f32>,
    _pad: u32,
}

// The components of `direction` in the frame of `normal`.
fn in_frame(normal: vec3<f32>, direction: vec3<f32>) -> vec3<f32> {
    let along = dot(normal, direction);
    return vec3(direction.xy - normal.xy * ((along + direction.z) / (1.0 + normal.z)), along);
}

// w_i * w_o by components in the frame of `normal`: what a lobe in it is a function of.
fn product_in_frame(normal: vec3<f32>, view: vec3<f32>, light: vec3<f32>) -> vec3<f32> {
    return in_frame(normal, view) * in_frame(normal, light);
}
