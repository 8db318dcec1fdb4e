// What reconstruct and plane both read: the material's maps, the directions and the switches (stage::Surface).

struct Scene {
    // unit vectors that point away from the surface, x right, y up, z out; w = 0
    view: vec4<f32>,
    light: vec4<f32>,
    width: u32,
    height: u32,
    boundary: u32,
    // switches (model::Relief)
    displace: u32,
    shadow: u32,
    // bounds of `heights`
    lowest: f32,
    highest: f32,
    // tangent of the light's angular width
    penumbra: f32,
    // the coat's Fresnel reflectance at normal incidence and its GGX alpha
    f0: f32,
    roughness: f32,
    _pad0: u32,
    _pad1: u32,
}

@group(0) @binding(0) var<uniform> scene: Scene;
// all [row][column]; texel widths, positive outwards, the paint's thickness included
@group(0) @binding(1) var<storage, read> heights: array<f32>;
// unit normals of `heights`, w = 0
@group(0) @binding(2) var<storage, read> normals: array<vec4<f32>>;
// rho_d of the unpainted material per channel, reflectance
@group(0) @binding(3) var<storage, read> diffuse: array<vec4<f32>>;
// rho_s of the unpainted material per channel
@group(0) @binding(4) var<storage, read> specular: array<vec4<f32>>;
// (C_x, C_y, C_z, n)
@group(0) @binding(5) var<storage, read> lobes: array<vec4<f32>>;
// Kubelka-Munk reflectance per channel, w = how much of the texel is painted, 0 to 1
@group(0) @binding(6) var<storage, read> painted: array<vec4<f32>>;
