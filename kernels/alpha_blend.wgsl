// Paint taken for a colour, from the bottom up: the colour of each layer covers what lies below it by its drawn thickness
// (Porter, Duff 1984: over). What painting is without optics, for comparison. One thread a texel. Twin: reference::alpha_blend.
#import thread

struct Params {
    texels: u32,
    layers: u32,
    _pad: vec2<u32>,
}

@group(0) @binding(0) var<uniform> params: Params;
// [layer], rgb, w = 0
@group(0) @binding(1) var<storage, read> colours: array<vec4<f32>>;
// [layer][texel], drawn thickness 0..1
@group(0) @binding(2) var<storage, read> drawn: array<f32>;
// [texel], rgb of the ground and then of the paint on it; w coverage, how much of the texel is painted
@group(0) @binding(3) var<storage, read_write> painted: array<vec4<f32>>;

const SIZE: u32 = 64u;

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    if texel >= params.texels {
        return;
    }
    var colour = painted[texel].rgb;
    var coverage = painted[texel].w;
    for (var index = 0u; index < params.layers; index++) {
        let alpha = drawn[index * params.texels + texel];
        coverage = alpha + coverage * (1.0 - alpha);
        colour = mix(colour, colours[index].rgb, alpha / max(coverage, 1e-20));
    }
    painted[texel] = vec4(colour, coverage);
}
