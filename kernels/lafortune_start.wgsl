// Begins a descent of each texel's Lafortune fit: keeps the better of the last descent and the champion, then starts at
// the given point, or at the champion if the given exponent is 0. A texel without a specular part or with too few valid
// samples does not start. One thread a texel.
// Twin: reference::lafortune_fit.
#import thread
#import lafortune_state

struct Params {
    // (k, n) to start from; n = 0: the champion
    start: vec4<f32>,
    texels: u32,
    // 1 for the first descent, before which the state means nothing
    first: u32,
    // valid samples that a fit takes at least
    min_valid: u32,
    _pad: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [texel]
@group(0) @binding(1) var<storage, read> energies: array<Energy>;
// [texel]
@group(0) @binding(2) var<storage, read_write> states: array<FitState>;

const SIZE: u32 = 64u;

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    if texel >= params.texels {
        return;
    }
    var state = FitState();
    state.champion_objective = -1.0;
    if params.first == 0u {
        let last = states[texel];
        state.iterations = last.iterations;
        state.champion = last.champion;
        state.champion_objective = last.champion_objective;
        state.champion_amplitude = last.champion_amplitude;
        if last.objective >= 0.0 && (last.champion_objective < 0.0 || last.objective < last.champion_objective) {
            state.champion = last.point;
            state.champion_objective = last.objective;
            state.champion_amplitude = last.amplitude;
        }
    }
    state.candidate = params.start;
    if params.start.w == 0.0 {
        state.candidate = state.champion;
        state.amplitude = state.champion_amplitude;
    }
    state.point = state.candidate;
    state.objective = -1.0;
    state.energy = energies[texel].sum;
    state.damping = 1e-3;
    state.growth = 2.0;
    state.status = RUNNING;
    if energies[texel].valid < params.min_valid {
        state.status = TOO_FEW_SAMPLES;
        state.objective = state.energy;
    } else if state.energy == 0.0 {
        state.status = NO_SPECULAR;
        state.objective = 0.0;
    }
    states[texel] = state;
}
