// Puts the best of each texel's fits first, in the order of their objectives, to descend again from where they are; the others
// end. A texel's first fit counts the steps of all. One thread a texel.
// Twin: reference::lafortune_fit.
#import thread
#import lafortune_state

struct Params {
    texels: u32,
    // of each texel, before and from here on
    fits: u32,
    kept: u32,
    _pad: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [start][texel], then [place][texel]
@group(0) @binding(1) var<storage, read_write> states: array<FitState>;

const SIZE: u32 = 64u;

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    if texel >= params.texels {
        return;
    }
    if states[texel].status == TOO_FEW_SAMPLES || states[texel].status == NO_SPECULAR {
        return;
    }
    var iterations = 0u;
    for (var fit = 0u; fit < params.fits; fit++) {
        iterations += states[fit * params.texels + texel].iterations;
    }
    for (var place = 0u; place < params.kept; place++) {
        let to = place * params.texels + texel;
        var best = to;
        for (var fit = place + 1u; fit < params.fits; fit++) {
            let other = fit * params.texels + texel;
            if states[other].objective < states[best].objective {
                best = other;
            }
        }
        var state = states[best];
        states[best] = states[to];
        state.candidate = state.point;
        state.objective = -1.0;
        state.damping = START_DAMPING;
        state.growth = 2.0;
        state.status = RUNNING;
        state.iterations = select(0u, iterations, place == 0u);
        states[to] = state;
    }
}
