// One layer of paint over a ground: new diffuse reflectance R + T^2 rho_d/(1 - R rho_d) (Kubelka, Munk 1931; thesis eqs. 3.7,
// 3.9) for the film of thickness d = thickness x drawn, and the coverage of paint so far. One thread a texel.
// Twin: reference::kubelka_munk.
#import thread
#import film

struct Params {
    // K x thickness, rgb: absorption where the drawn thickness is 1
    absorption: vec4<f32>,
    // S x thickness, rgb
    scattering: vec4<f32>,
    // drawn thickness from which the layer is closed
    closed: f32,
    texels: u32,
    _pad: vec2<u32>,
}

@group(0) @binding(0) var<uniform> params: Params;
// [texel], rho_d in rgb, coverage of the layers below in w (0 on bare material)
@group(0) @binding(1) var<storage, read> ground: array<vec4<f32>>;
// [texel], drawn thickness 0..1
@group(0) @binding(2) var<storage, read> drawn: array<f32>;
// [texel], rho_d in rgb, coverage in w
@group(0) @binding(3) var<storage, read_write> painted: array<vec4<f32>>;

const SIZE: u32 = 64u;

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    if texel >= params.texels {
        return;
    }
    let below = ground[texel];
    let thickness = drawn[texel];
    let coat = film(params.scattering.rgb * thickness, params.absorption.rgb * thickness);
    let bare = (1.0 - below.w) * (1.0 - smoothstep(0.0, params.closed, thickness));
    painted[texel] = vec4(over_substrate(coat, below.rgb), 1.0 - bare);
}
