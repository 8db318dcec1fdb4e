// What reconstruct and plane both read: the material's maps, the directions and the switches (stage::Surface).
#import height_field
#import painted

// [row][column] where nothing else is said
// rho_d of the unpainted material per channel, reflectance
@group(0) @binding(3) var<storage, read> diffuse: array<vec4<f32>>;
// [lobe][row][column], rho_s of the unpainted material per channel
@group(0) @binding(4) var<storage, read> specular: array<vec4<f32>>;
// [lobe][row][column], (C_x, C_y, C_z, n)
@group(0) @binding(5) var<storage, read> lobes: array<vec4<f32>>;
@group(0) @binding(6) var<storage, read> painted: array<PaintedTexel>;
