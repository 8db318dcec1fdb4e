// Edges, ridges and grain of drawn paint that are never finer than a texel. Lengths in the coordinates of the pattern, `texel` the
// width of one there.
#import noise

// 0 below `low`, 1 above `high`, smooth between (3t^2 - 2t^3); at least a texel wide, about the same middle.
fn edge(low: f32, high: f32, value: f32, texel: f32) -> f32 {
    let t = saturate(0.5 + (value - 0.5 * (low + high)) / max(high - low, texel));
    return t * t * (3.0 - 2.0 * t);
}

// 1 at the middle of a ridge, falling off as exp(-(distance/width)^2); a wider and lower one of the same area if that is below a texel.
fn ridge(distance: f32, width: f32, texel: f32) -> f32 {
    let least = max(width, texel);
    return width / least * exp(-distance * distance / (least * least));
}

// Noise whose lattice is `texel_cells` of its cells a texel: whole up to half a cell, none from a cell on.
fn faded(value: f32, texel_cells: f32) -> f32 {
    return mix(0.5, value, saturate(2.0 - 2.0 * texel_cells));
}

// Noise that need not repeat, with `cells` lattice cells a unit of length.
fn grain(place: vec2<f32>, cells: vec2<f32>, seed: u32, texel: f32) -> f32 {
    return faded(noise(place * cells, vec2(65536u), seed), max(cells.x, cells.y) * texel);
}

// Integral from -reach to x of the parabola 3/4 (1 - (x/reach)^2)/reach: a step, averaged with it.
fn step_over(x: f32, reach: f32) -> f32 {
    let t = clamp(x / reach, -1.0, 1.0);
    return 0.5 + t * (0.75 - 0.25 * t * t);
}
