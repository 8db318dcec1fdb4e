// The bare material by its per-texel reflectance (thesis eq. 3.3), for `shade`. Twin: reference::shade.
#import lafortune
#import shading_frame

// [row][column] where nothing else is said
// rho_d per channel, reflectance
@group(0) @binding(5) var<storage, read> diffuse: array<vec4<f32>>;
// [lobe][row][column], rho_s per channel
@group(0) @binding(6) var<storage, read> specular: array<vec4<f32>>;
// [lobe][row][column], (C_x, C_y, C_z, n)
@group(0) @binding(7) var<storage, read> lobes: array<vec4<f32>>;

// Frames of the reflectance (model::Frame).
const FRAME_PLANE: u32 = 0u;
const FRAME_TEXEL: u32 = 1u;

// Reflectance of a texel, pi f_r, in the frame of a normal.
fn reflectance_of(texel: u32, normal: vec3<f32>, view: vec3<f32>, light: vec3<f32>) -> vec3<f32> {
    let product = product_in_frame(normal, view, light);
    var reflectance = diffuse[texel].rgb;
    for (var lobe = 0u; lobe < scene.lobes; lobe++) {
        let at = lobe * scene.width * scene.height + texel;
        reflectance += specular[at].rgb * lafortune(lobes[at], product);
    }
    return reflectance;
}

// Of a flat surface the reflectance moves with the relief. One that was fitted in a frame of its own is that of the base plane's
// place, as a measurement has it: seen obliquely, the same place shows another point of the surface, whose normal is the frame's.
fn unpainted_radiance(base: vec2<f32>, hit: Hit, visible: f32, view: vec3<f32>, light: vec3<f32>) -> vec3<f32> {
    var place = base;
    var normal = vec3(0.0, 0.0, 1.0);
    var lit = visible * light.z;
    if scene.frame == FRAME_PLANE {
        place = hit.place;
    } else {
        normal = normal_at(select(hit.place, base, scene.frame == FRAME_TEXEL));
        // Shadows that no frame tells are in the measured reflectance.
        let seen = select(visible, 1.0, scene.frame == FRAME_TEXEL);
        lit = mix(seen * max(dot(normal, light), 0.0), light.z, scene.ambient);
    }
    let cell = cell_at(place);
    let weights = weights_of(cell);
    var reflectance = vec3(0.0);
    for (var corner = 0u; corner < 4u; corner++) {
        if weights[corner] > 0.0 {
            reflectance += weights[corner] * reflectance_of(cell.texels[corner], normal, view, light);
        }
    }
    return reflectance * lit;
}
