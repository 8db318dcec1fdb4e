// A splash of paint: capsules that flow together, the edge frayed by noise, paint standing up at the rim (model::pattern).
// Twin: reference::pattern.
#import pattern_marks

struct Capsule {
    // centres of the ends, pattern coordinates
    ends: vec4<f32>,
    // radii at the ends
    radii: vec2<f32>,
    _pad: vec2<f32>,
}

// Bins along each edge of the square from -0.5 to 0.5 that holds a splash.
const SPLASH_BINS: u32 = 16u;
// Distance from a shape's outline at which it ends having a part in the splash.
const FLOW: f32 = 0.05;

fn splash_bin(place: vec2<f32>) -> u32 {
    let bin = vec2<u32>(clamp((place + 0.5) * f32(SPLASH_BINS), vec2(0.0), vec2(f32(SPLASH_BINS) - 0.5)));
    return bin.y * SPLASH_BINS + bin.x;
}

// Distance to a capsule's outline, negative inside.
fn outline(place: vec2<f32>, capsule: Capsule) -> f32 {
    let axis = capsule.ends.zw - capsule.ends.xy;
    let from = place - capsule.ends.xy;
    let part = saturate(dot(from, axis) / max(dot(axis, axis), 1e-12));
    return length(from - part * axis) - mix(capsule.radii.x, capsule.radii.y, part);
}

// A shape's share in the sum whose level 1 is the outline of all together (Wyvill, McPheeters, Wyvill 1986: soft objects).
fn flow(outline: f32) -> f32 {
    let share = max(1.0 - outline / FLOW, 0.0);
    return share * share * share * share;
}

// Distance to the outline of all: that of a shape where it is alone.
fn joined(sum: f32) -> f32 {
    return FLOW * (1.0 - sqrt(sqrt(sum)));
}

// Thickness at `place`, `distance` from the outline of all shapes.
fn splash(place: vec2<f32>, distance: f32, seed: u32, texel: f32) -> f32 {
    const EDGE: f32 = 0.009;
    const RIM_DEPTH: f32 = 0.013;
    const RIM_WIDTH: f32 = 0.009;
    let fray = 0.010 * (grain(place, vec2(14.0), seed, texel) - 0.5) + 0.004 * (grain(place, vec2(45.0), seed + 1u, texel) - 0.5);
    let depth = -(distance + fray);
    let pool = 0.45 + 0.2 * grain(place, vec2(7.0), seed + 2u, texel);
    return edge(0.0, EDGE, depth, texel) * mix(pool, 1.0, ridge(depth - RIM_DEPTH, RIM_WIDTH, texel));
}
