// Layers of paint over a ground, from the bottom up: diffuse reflectance R + T^2 rho_d/(1 - R rho_d) of films of thickness
// d = thickness x drawn (Kubelka, Munk 1931; Kubelka 1948; thesis eqs. 3.7 to 3.9), height + relief x drawn, coverage and the
// topmost surface. One thread a texel, all layers of a batch in its registers; batches follow each other where one would not
// fit a binding.
// A measured ground may exceed 1, where the series behind the formula has no sum. It counts as white, and what it has more is
// seen through the whole stack once, T^2 x excess: so a layer that is divided into several stays the same paint.
// Twin: reference::kubelka_munk.
#import thread
#import film

struct Params {
    texels: u32,
    layers: u32,
    // 1 if earlier batches left something
    continues: u32,
    // 1 if another batch follows
    continued: u32,
    // drawn thickness from which a layer is closed
    closed: f32,
    _pad0: u32,
    _pad1: u32,
    _pad2: u32,
}

struct Layer {
    // K x thickness: absorption where the drawn thickness is 1
    absorption: vec3<f32>,
    // texel widths where the drawn thickness is 1
    relief: f32,
    // S x thickness
    scattering: vec3<f32>,
    _pad0: f32,
    // of its surface: reflectance at normal incidence and GGX alpha
    coat: vec2<f32>,
    _pad1: vec2<f32>,
}

@group(0) @binding(0) var<uniform> params: Params;
// [layer] of the batch, from the bottom up
@group(0) @binding(1) var<storage, read> layers: array<Layer>;
// [layer][texel], drawn thickness 0..1
@group(0) @binding(2) var<storage, read> drawn: array<f32>;
// [texel], rgb rho_d of the ground and, after the last batch, of the paint on it; w coverage, how much of the texel is painted
@group(0) @binding(3) var<storage, read_write> painted: array<vec4<f32>>;
// [texel], of the topmost surface: reflectance at normal incidence and GGX alpha
@group(0) @binding(4) var<storage, read_write> coats: array<vec2<f32>>;
// [texel], texel widths, positive outwards
@group(0) @binding(5) var<storage, read_write> heights: array<f32>;
// What one batch leaves to the next, [texel], rgb: reflectance over the ground held to 1, over black, and transmittance
@group(0) @binding(6) var<storage, read_write> over_ground: array<vec4<f32>>;
@group(0) @binding(7) var<storage, read_write> over_black: array<vec4<f32>>;
@group(0) @binding(8) var<storage, read_write> transmittance: array<vec4<f32>>;

const SIZE: u32 = 64u;

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    if texel >= params.texels {
        return;
    }
    let ground = painted[texel].rgb;
    var coverage = painted[texel].w;
    var coat = coats[texel];
    var height = heights[texel];
    let white = min(ground, vec3(1.0));
    // Of the layers laid so far.
    var reflected = white;
    var black = vec3(0.0);
    var passed = vec3(1.0);
    if params.continues == 1u {
        reflected = over_ground[texel].rgb;
        black = over_black[texel].rgb;
        passed = transmittance[texel].rgb;
    }
    for (var index = 0u; index < params.layers; index++) {
        let thickness = drawn[index * params.texels + texel];
        if thickness == 0.0 {
            continue;
        }
        let layer = layers[index];
        let sheet = film(layer.scattering * thickness, layer.absorption * thickness);
        passed *= through(sheet, black);
        black = over_substrate(sheet, black);
        reflected = over_substrate(sheet, reflected);
        height += layer.relief * thickness;
        // Of what is covered, the share in which this layer is the topmost.
        let covering = smoothstep(0.0, params.closed, thickness);
        coverage += covering * (1.0 - coverage);
        coat = mix(coat, layer.coat, covering / max(coverage, 1e-20));
    }
    coats[texel] = coat;
    heights[texel] = height;
    if params.continued == 1u {
        painted[texel] = vec4(ground, coverage);
        over_ground[texel] = vec4(reflected, 0.0);
        over_black[texel] = vec4(black, 0.0);
        transmittance[texel] = vec4(passed, 0.0);
    } else {
        painted[texel] = vec4(reflected + passed * passed * (ground - white), coverage);
    }
}
