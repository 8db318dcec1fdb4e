// A texel's paint, as it is rendered (stage::PaintedTexel).

struct PaintedTexel {
    // diffuse reflectance of the paint on what lies below it; on bare material that of the material
    reflectance: vec3<f32>,
    // how much of the texel is painted, 0 to 1
    coverage: f32,
    // of the topmost paint's surface: reflectance at normal incidence and GGX alpha
    f0: f32,
    roughness: f32,
    _pad: vec2<f32>,
}
