// Begins the fits of each texel, one from each starting point. A texel without a specular part or with too few valid
// samples does not start. One thread a fit. Twin: reference::lafortune_fit.
#import thread
#import lafortune_state

struct Params {
    texels: u32,
    fits: u32,
    // valid samples that a fit takes at least
    min_valid: u32,
    _pad: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [start], (k, n)
@group(0) @binding(1) var<storage, read> starts: array<vec4<f32>>;
// [texel]
@group(0) @binding(2) var<storage, read> energies: array<Energy>;
// [start][texel]
@group(0) @binding(3) var<storage, read_write> states: array<FitState>;

const SIZE: u32 = 64u;

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let fit = thread_index(group, groups, local, SIZE);
    if fit >= params.fits {
        return;
    }
    let energy = energies[fit % params.texels];
    var state = FitState();
    state.candidate = starts[fit / params.texels];
    state.point = state.candidate;
    state.objective = -1.0;
    state.energy = energy.sum;
    state.damping = START_DAMPING;
    state.growth = 2.0;
    state.status = RUNNING;
    if energy.valid < params.min_valid {
        state.status = TOO_FEW_SAMPLES;
        state.objective = energy.sum;
    } else if energy.sum == 0.0 {
        state.status = NO_SPECULAR;
        state.objective = 0.0;
    }
    states[fit] = state;
}
