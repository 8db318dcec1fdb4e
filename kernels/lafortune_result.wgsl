// Ends each texel's Lafortune fit: the lobe with its scale in C, C = k A^(1/n), and the diagnostics. One thread a texel.
// Twin: reference::lafortune_fit.
#import thread
#import lafortune_state

struct Params {
    texels: u32,
    _pad0: u32,
    _pad1: u32,
    _pad2: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [texel]
@group(0) @binding(1) var<storage, read> states: array<FitState>;
// [texel]
@group(0) @binding(2) var<storage, read> energies: array<Energy>;
// [texel], (C_x, C_y, C_z, n); C = 0 and n = 1: no lobe
@group(0) @binding(3) var<storage, read_write> lobes: array<vec4<f32>>;
// [texel], mean squared residual of the valid samples without a lobe and with it, reflectance^2
@group(0) @binding(4) var<storage, read_write> objectives: array<vec2<f32>>;
// [texel], FitStatus and steps tried
@group(0) @binding(5) var<storage, read_write> outcomes: array<vec2<u32>>;

const SIZE: u32 = 64u;

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    if texel >= params.texels {
        return;
    }
    let state = states[texel];
    var lobe = vec4(0.0, 0.0, 0.0, 1.0);
    if state.amplitude > 0.0 {
        lobe = vec4(state.point.xyz * exp2(min(log2(state.amplitude) / state.point.w, 64.0)), state.point.w);
    }
    lobes[texel] = lobe;
    objectives[texel] = vec2(state.energy, state.objective) / f32(max(energies[texel].valid, 1u));
    outcomes[texel] = vec2(state.status, state.iterations);
}
