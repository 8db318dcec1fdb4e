// Drawn thickness of stripes: `amount` of each period, around whole phases, averaged with a parabola that is no narrower than a texel.
// One thread a texel.
// Twin: reference::pattern.
#import pattern_plane

// Half the width of the softest edge, in periods.
const SOFT: f32 = 0.06;

// Integral from -reach to x of the parabola 3/4 (1 - (x/reach)^2)/reach: a step, averaged with it.
fn step_over(x: f32, reach: f32) -> f32 {
    let t = clamp(x / reach, -1.0, 1.0);
    return 0.5 + t * (0.75 - 0.25 * t * t);
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    if outside(texel) {
        return;
    }
    let periods = params.wave / params.edges;
    let phase = dot(place_of(texel), periods);
    let texel_periods = length(periods) / min(params.cell.x, params.cell.y);
    let reach = clamp(texel_periods, SOFT, 1.0);
    var painted = 0.0;
    for (var period = -1; period <= 1; period++) {
        let from_middle = phase - round(phase) - f32(period);
        painted += step_over(from_middle + 0.5 * params.amount, reach) - step_over(from_middle - 0.5 * params.amount, reach);
    }
    // Of periods finer than a texel only their mean is left.
    drawn[params.first + texel] = mix(saturate(painted), params.amount, saturate(texel_periods - 1.0));
}
