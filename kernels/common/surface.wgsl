// What reconstruct and plane both read: the material's maps, the directions and the switches (stage::Surface).
#import height_field

// [row][column] where nothing else is said
// rho_d of the unpainted material per channel, reflectance
@group(0) @binding(3) var<storage, read> diffuse: array<vec4<f32>>;
// [lobe][row][column], rho_s of the unpainted material per channel
@group(0) @binding(4) var<storage, read> specular: array<vec4<f32>>;
// [lobe][row][column], (C_x, C_y, C_z, n)
@group(0) @binding(5) var<storage, read> lobes: array<vec4<f32>>;
// rgb: diffuse reflectance of the paint on what lies below it; w: coverage, how much of the texel is painted, 0 to 1
@group(0) @binding(6) var<storage, read> painted: array<vec4<f32>>;
// of the topmost paint's surface: reflectance F0 at normal incidence and GGX alpha
@group(0) @binding(7) var<storage, read> coats: array<vec2<f32>>;
