// A stroke of a brush along x: noise drawn out along it.
// Twin: reference::pattern.
#import pattern_marks

// Thickness at `place` of a stroke that is `width` wide.
fn brush(place: vec2<f32>, width: f32, seed: u32, texel: f32) -> f32 {
    const HALF_LENGTH: f32 = 0.4;
    // The hand wavers and presses unevenly.
    let waver = 0.2 * width * (grain(vec2(place.x, 0.5), vec2(4.0, 1.0), seed, texel) - 0.5);
    let press = 0.5 * width * (0.92 + 0.16 * grain(vec2(place.x, 0.5), vec2(9.0, 1.0), seed + 1u, texel));
    // -1..1 across the stroke, 0..1 along it; a texel of each.
    let across = (place.y - waver) / press;
    let run = 0.5 + 0.5 * place.x / HALF_LENGTH;
    let texel_across = texel / press;
    let texel_run = 0.5 * texel / HALF_LENGTH;
    // Bristles: marks that hardly change along the stroke, fine ones on coarse ones.
    let frame = vec2(run, across);
    let mark = mix(grain(frame, vec2(3.0, 6.0), seed + 2u, texel_across), grain(frame, vec2(5.0, 19.0), seed + 3u, texel_across), 0.55);
    // The brush empties: grooves open, and bristle by bristle lets go.
    let groove = smoothstep(0.1 + 0.3 * run, 0.5 + 0.25 * run, mark);
    let last = 0.66 + 0.34 * grain(vec2(0.5, across), vec2(1.0, 14.0), seed + 4u, texel_across);
    let first = 0.05 * across * across + 0.03 * grain(vec2(0.5, across), vec2(1.0, 9.0), seed + 5u, texel_across);
    let ends = edge(first, first + 0.05, run, texel_run) * (1.0 - edge(last - 0.16, last, run, texel_run));
    let side = 1.0 - edge(0.86, 1.0, abs(across), texel_across);
    // Paint is pushed to the sides and lies thick where the brush came down.
    let border = 0.3 * edge(0.6, 0.85, abs(across), texel_across) + 0.3 * (1.0 - edge(0.03, 0.16, run, texel_run));
    let body = 0.3 * saturate(1.0 - 1.3 * run) + 0.6 * groove + border;
    return ends * side * saturate(body);
}
