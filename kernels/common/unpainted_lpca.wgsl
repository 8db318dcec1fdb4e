// The bare material by its local PCA, for `shade`: the original's full look. It has its own parallax and shadows, as seen on the base
// plane, and so it is looked up where the ray crosses that plane, and under all of the light. Twin: reference::reconstruct_lpca.
#import lpca

fn unpainted_radiance(base: vec2<f32>, hit: Hit, visible: f32, view: vec3<f32>, light: vec3<f32>) -> vec3<f32> {
    return compressed_radiance(base, view, light);
}
