// Layers of paint over a ground, from the bottom up: diffuse reflectance R + T^2 rho_d/(1 - R rho_d) of films of thickness
// d = thickness x drawn (Kubelka, Munk 1931; Kubelka 1948; thesis eqs. 3.7 to 3.9), height + relief x drawn, coverage and the
// topmost surface. One thread a texel, all layers of a batch in its registers; batches follow each other where one would not
// fit a binding.
// A measured ground may exceed 1, where the series behind the formula has no sum. It counts as white, and what it has more is
// seen through the whole stack once, T^2 x excess: so a layer that is divided into several stays the same paint.
// Twin: reference::kubelka_munk.
#import thread
#import film
#import painted

struct Params {
    texels: u32,
    layers: u32,
    // 1 if `between` has what earlier batches left
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
    // of its surface: reflectance at normal incidence and GGX alpha
    f0: f32,
    roughness: f32,
    _pad0: f32,
    _pad1: f32,
    _pad2: f32,
}

// The layers laid so far.
struct Stack {
    // reflectance over the ground, held to 1
    over_ground: vec3<f32>,
    _pad0: f32,
    // reflectance over black, R
    over_black: vec3<f32>,
    _pad1: f32,
    // T
    transmittance: vec3<f32>,
    _pad2: f32,
    // what the ground has above 1
    excess: vec3<f32>,
    _pad3: f32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [layer] of the batch, from the bottom up
@group(0) @binding(1) var<storage, read> layers: array<Layer>;
// [layer][texel], drawn thickness 0..1
@group(0) @binding(2) var<storage, read> drawn: array<f32>;
// [texel], of the ground and then of the paint on it
@group(0) @binding(3) var<storage, read_write> painted: array<PaintedTexel>;
// [texel], texel widths, positive outwards
@group(0) @binding(4) var<storage, read_write> heights: array<f32>;
// [texel] where there are several batches
@group(0) @binding(5) var<storage, read_write> between: array<Stack>;

const SIZE: u32 = 64u;

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    if texel >= params.texels {
        return;
    }
    var paint = painted[texel];
    var height = heights[texel];
    var stack: Stack;
    if params.continues == 1u {
        stack = between[texel];
    } else {
        stack.over_ground = min(paint.reflectance, vec3(1.0));
        stack.transmittance = vec3(1.0);
        stack.excess = paint.reflectance - stack.over_ground;
    }
    for (var index = 0u; index < params.layers; index++) {
        let thickness = drawn[index * params.texels + texel];
        if thickness == 0.0 {
            continue;
        }
        let layer = layers[index];
        let coat = film(layer.scattering * thickness, layer.absorption * thickness);
        stack.transmittance *= through(coat, stack.over_black);
        stack.over_black = over_substrate(coat, stack.over_black);
        stack.over_ground = over_substrate(coat, stack.over_ground);
        height += layer.relief * thickness;
        // Of what is covered, the share that this layer's surface is.
        let covering = smoothstep(0.0, params.closed, thickness);
        paint.coverage = 1.0 - (1.0 - paint.coverage) * (1.0 - covering);
        let top = covering / max(paint.coverage, 1e-20);
        paint.f0 = mix(paint.f0, layer.f0, top);
        paint.roughness = mix(paint.roughness, layer.roughness, top);
    }
    paint.reflectance = stack.over_ground + stack.transmittance * stack.transmittance * stack.excess;
    painted[texel] = paint;
    heights[texel] = height;
    if params.continued == 1u {
        between[texel] = stack;
    }
}
