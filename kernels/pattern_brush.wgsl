// Drawn thickness of a stroke of a brush along x: noise drawn out along it. One thread a texel.
// Twin: reference::pattern.
#import pattern_plane
#import pattern_marks

fn brush(place: vec2<f32>) -> f32 {
    const HALF_LENGTH: f32 = 0.39;
    let width = params.amount;
    // The hand wavers and presses unevenly.
    let waver = 0.2 * width * (grain(vec2(place.x, 0.5), vec2(4.0, 1.0), 0u) - 0.5);
    let press = 0.5 * width * (0.92 + 0.16 * grain(vec2(place.x, 0.5), vec2(9.0, 1.0), 1u));
    // -1..1 across the stroke, 0..1 along it; a texel of each.
    let across = (place.y - waver) / press;
    let run = 0.5 + 0.5 * place.x / HALF_LENGTH;
    let texel_across = params.texel / press;
    let texel_run = 0.5 * params.texel / HALF_LENGTH;
    // Bristles: marks that hardly change along the stroke, fine ones on coarse ones.
    let frame = vec2(run, across);
    let coarse = grain_in(frame, vec2(3.0, 6.0), params.seed + 2u, texel_across);
    let middling = grain_in(frame, vec2(5.0, 19.0), params.seed + 3u, texel_across);
    let fine = grain_in(frame, vec2(7.0, 47.0), params.seed + 4u, texel_across);
    let mark = 0.4 * coarse + 0.4 * middling + 0.2 * fine;
    // The brush empties: grooves open, and bristle by bristle lets go.
    let groove = smoothstep(0.1 + 0.3 * run, 0.5 + 0.25 * run, mark);
    let last = 0.66 + 0.34 * grain_in(vec2(0.5, across), vec2(1.0, 14.0), params.seed + 5u, texel_across);
    let first = 0.05 * across * across + 0.03 * grain_in(vec2(0.5, across), vec2(1.0, 9.0), params.seed + 6u, texel_across);
    let ends = edge(first, first + 0.05, run, texel_run) * (1.0 - edge(last - 0.16, last, run, texel_run));
    let side = 1.0 - edge(0.86, 1.0, abs(across), texel_across);
    // Paint is pushed to the sides and lies thick where the brush came down.
    let border = 0.3 * edge(0.6, 0.85, abs(across), texel_across) + 0.3 * (1.0 - edge(0.03, 0.16, run, texel_run));
    let body = 0.3 * saturate(1.0 - 1.3 * run) + 0.6 * groove + border;
    return ends * side * saturate(body);
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    if outside(texel) {
        return;
    }
    let place = place_of(texel);
    // Where repetitions meet, the thickest paint shows.
    var thickness = 0.0;
    for (var index = 0u; index < repetitions(); index++) {
        let own = in_repetition(place, index);
        if !beyond(own) {
            thickness = max(thickness, brush(own));
        }
    }
    drawn[params.first + texel] = thickness;
}
