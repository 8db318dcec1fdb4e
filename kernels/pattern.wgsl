// A procedural pattern: the thickness drawn at each texel, 0 (bare) to 1, over a plane that repeats. One thread a texel.
// Tile coordinates: origin in the middle of the plane, x right, y up, its shorter edge 1 long (model::pattern).
// A splash is a smooth union of capsules (Quilez 2013: polynomial smooth minimum), its edge frayed by noise, with a rim.
// A brush stroke is noise drawn out along it.
// Twin: reference::pattern.
#import thread
#import noise

struct Params {
    width: u32,
    height: u32,
    // model::Pattern::code
    pattern: u32,
    seed: u32,
    // cosine and sine of the stroke's direction
    along: vec2<f32>,
    // width of the stroke, tile coordinates
    brush: f32,
    shapes: u32,
    // index of the layer's first texel
    first: u32,
    _pad0: u32,
    _pad1: u32,
    _pad2: u32,
}

struct Capsule {
    // centres of the ends, tile coordinates
    ends: vec4<f32>,
    // radii at the ends
    radii: vec2<f32>,
    _pad: vec2<f32>,
}

@group(0) @binding(0) var<uniform> params: Params;
// [shape], of a splash
@group(0) @binding(1) var<storage, read> shapes: array<Capsule>;
// [layer][row][column], drawn thickness 0..1
@group(0) @binding(2) var<storage, read_write> drawn: array<f32>;

const SIZE: u32 = 64u;
const SPLASH: u32 = 1u;
const BRUSH: u32 = 2u;

// Shapes nearer than this flow together.
const FLOW: f32 = 0.035;
// Depth inside the outline at which paint is closed, and depth and width of the rim.
const EDGE: f32 = 0.009;
const RIM_DEPTH: f32 = 0.013;
const RIM_WIDTH: f32 = 0.009;

// Lengths of the plane's edges, the shorter one 1.
fn edges() -> vec2<f32> {
    let size = vec2(f32(params.width), f32(params.height));
    return size / min(size.x, size.y);
}

// Noise of `count` lattice points along the shorter edge that closes at the edges of the plane.
fn tiled_noise(place: vec2<f32>, count: u32, seed: u32) -> f32 {
    let size = vec2(params.width, params.height);
    let shorter = min(size.x, size.y);
    let period = (2u * count * size + shorter) / (2u * shorter);
    return noise((place / edges() + 0.5) * vec2<f32>(period), period, seed);
}

// Distance from `place` to a capsule's outline in its nearest repetition, negative inside.
fn outline(place: vec2<f32>, capsule: Capsule) -> f32 {
    let axis = capsule.ends.zw - capsule.ends.xy;
    let middle = 0.5 * (capsule.ends.xy + capsule.ends.zw);
    let apart = place - middle;
    let near = apart - edges() * round(apart / edges());
    let part = saturate(dot(near + 0.5 * axis, axis) / max(dot(axis, axis), 1e-12));
    return length(near - (part - 0.5) * axis) - mix(capsule.radii.x, capsule.radii.y, part);
}

fn splash(place: vec2<f32>) -> f32 {
    var distance = 1.0;
    for (var index = 0u; index < params.shapes; index++) {
        let other = outline(place, shapes[index]);
        let bridge = max(FLOW - abs(distance - other), 0.0);
        distance = min(distance, other) - bridge * bridge / (4.0 * FLOW);
    }
    let fray = 0.010 * (tiled_noise(place, 14u, params.seed) - 0.5) + 0.004 * (tiled_noise(place, 45u, params.seed + 1u) - 0.5);
    let depth = -(distance + fray);
    let rim = (depth - RIM_DEPTH) / RIM_WIDTH;
    let pool = 0.45 + 0.2 * tiled_noise(place, 7u, params.seed + 2u);
    return smoothstep(0.0, EDGE, depth) * mix(pool, 1.0, exp(-rim * rim));
}

// Noise in the frame of the stroke, which need not repeat.
fn stroke_noise(x: f32, y: f32, layer: u32) -> f32 {
    return noise(vec2(x, y), vec2(65536u), params.seed + layer);
}

fn brush(place: vec2<f32>) -> f32 {
    const HALF_LENGTH: f32 = 0.4;
    let along = vec2(dot(place, params.along), dot(place, vec2(-params.along.y, params.along.x)));
    // The hand wavers and presses unevenly.
    let waver = 0.2 * params.brush * (stroke_noise(4.0 * along.x, 0.5, 0u) - 0.5);
    let press = 0.5 * params.brush * (0.92 + 0.16 * stroke_noise(9.0 * along.x, 0.5, 1u));
    // -1..1 across the stroke, 0..1 along it.
    let across = (along.y - waver) / press;
    let run = 0.5 + 0.5 * along.x / HALF_LENGTH;
    // Bristles: marks that hardly change along the stroke, fine ones on coarse ones.
    let mark = mix(stroke_noise(3.0 * run, 6.0 * across, 2u), stroke_noise(5.0 * run, 19.0 * across, 3u), 0.55);
    // The brush empties: grooves open, and bristle by bristle lets go.
    let groove = smoothstep(0.1 + 0.3 * run, 0.5 + 0.25 * run, mark);
    let last = 0.66 + 0.34 * stroke_noise(0.5, 14.0 * across, 4u);
    let first = 0.05 * across * across + 0.03 * stroke_noise(0.5, 9.0 * across, 5u);
    let ends = smoothstep(first, first + 0.05, run) * (1.0 - smoothstep(last - 0.16, last, run));
    let side = 1.0 - smoothstep(0.86, 1.0, abs(across));
    // Paint is pushed to the sides and lies thick where the brush came down.
    let ridge = 0.3 * smoothstep(0.6, 0.85, abs(across)) + 0.3 * (1.0 - smoothstep(0.03, 0.16, run));
    let body = 0.3 * saturate(1.0 - 1.3 * run) + 0.6 * groove + ridge;
    return ends * side * saturate(body);
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    if texel >= params.width * params.height {
        return;
    }
    let column = f32(texel % params.width);
    let row = f32(texel / params.width);
    let size = vec2(f32(params.width), f32(params.height));
    let place = vec2(column + 0.5 - 0.5 * size.x, 0.5 * size.y - row - 0.5) / min(size.x, size.y);
    var thickness = 1.0;
    if params.pattern == SPLASH {
        thickness = splash(place);
    } else if params.pattern == BRUSH {
        thickness = brush(place);
    }
    drawn[params.first + texel] = thickness;
}
