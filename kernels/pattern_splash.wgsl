// Drawn thickness of a splash of paint: capsules that flow together, the edge frayed by noise, paint standing up at the rim
// (model::Pattern::Splash). The capsules are sorted into bins by their place. One thread a texel.
// Twin: reference::pattern.
#import pattern_plane
#import pattern_marks

struct Capsule {
    // centres of the ends, pattern coordinates
    ends: vec4<f32>,
    // radii at the ends
    radii: vec2<f32>,
    _pad: vec2<f32>,
}

// [row][column + 1 at the end of all]: index of the first shape near each bin
@group(0) @binding(2) var<storage, read> bins: array<u32>;
// [bin][shape]
@group(0) @binding(3) var<storage, read> shapes: array<Capsule>;

// Bins along each edge of the square from -0.5 to 0.5 that holds a splash.
const BINS: u32 = 16u;
// Distance from a shape's outline at which it ends having a part in the splash.
const FLOW: f32 = 0.05;

fn bin_of(place: vec2<f32>) -> u32 {
    let bin = vec2<u32>(clamp((place + 0.5) * f32(BINS), vec2(0.0), vec2(f32(BINS) - 0.5)));
    return bin.y * BINS + bin.x;
}

// Distance to a capsule's outline, negative inside.
fn outline(place: vec2<f32>, capsule: Capsule) -> f32 {
    let axis = capsule.ends.zw - capsule.ends.xy;
    let offset = place - capsule.ends.xy;
    let part = saturate(dot(offset, axis) / max(dot(axis, axis), 1e-12));
    return length(offset - part * axis) - mix(capsule.radii.x, capsule.radii.y, part);
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

fn splash(place: vec2<f32>) -> f32 {
    const EDGE: f32 = 0.009;
    const RIM_DEPTH: f32 = 0.013;
    const RIM_WIDTH: f32 = 0.009;
    let bin = bin_of(place);
    var sum = 0.0;
    for (var index = bins[bin]; index < bins[bin + 1u]; index++) {
        sum += flow(outline(place, shapes[index]));
    }
    let fray = 0.010 * grain(place, vec2(14.0), 0u) + 0.004 * grain(place, vec2(45.0), 1u) - 0.007;
    let depth = -(joined(sum) + fray);
    let pool = 0.3 + 0.3 * grain(place, vec2(7.0), 2u) + 0.2 * grain(place, vec2(19.0), 3u);
    return edge(0.0, EDGE, depth, params.texel) * mix(pool, 1.0, ridge(depth - RIM_DEPTH, RIM_WIDTH, params.texel));
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
            thickness = max(thickness, splash(own));
        }
    }
    drawn[params.first + texel] = thickness;
}
