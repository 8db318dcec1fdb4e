// Edges, ridges and grain of drawn paint that are never finer than a texel. Lengths in any unit, `texel` the width of one in it.
#import pattern_plane
#import noise

// 0 below `low`, 1 above `high`, smooth between (3t^2 - 2t^3); about the same middle at least 1.5 texels wide, where it is as steep as
// the mean over a texel.
fn edge(low: f32, high: f32, value: f32, texel: f32) -> f32 {
    let t = saturate(0.5 + (value - 0.5 * (low + high)) / max(high - low, 1.5 * texel));
    return t * t * (3.0 - 2.0 * t);
}

// 1 at the middle of a ridge, falling off as exp(-(distance/width)^2); a wider and lower one of the same area if that is below a texel.
fn ridge(distance: f32, width: f32, texel: f32) -> f32 {
    let least = max(width, texel);
    return width / least * exp(-distance * distance / (least * least));
}

// What is left of a texture of which a texel takes in `texel_cells` cells: all up to half a cell, its mean from a cell on.
fn faded(mean: f32, value: f32, texel_cells: f32) -> f32 {
    return mix(mean, value, saturate(2.0 - 2.0 * texel_cells));
}

// Noise that need not repeat, with `cells` lattice cells a unit of length.
fn grain_in(place: vec2<f32>, cells: vec2<f32>, seed: u32, texel: f32) -> f32 {
    return faded(0.5, noise(place * cells, vec2(65536u), seed), max(cells.x, cells.y) * texel);
}

// The same in pattern coordinates, another one for each `index`.
fn grain(place: vec2<f32>, cells: vec2<f32>, index: u32) -> f32 {
    return grain_in(place, cells, params.seed + index, params.texel);
}
