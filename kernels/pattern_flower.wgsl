// Drawn thickness of a flower seen from above: two leaves, petals that overlap, a centre of dots, each laid over what lies below it,
// which it presses aside. One thread a texel.
// Twin: reference::pattern.
#import pattern_plane
#import pattern_marks

const TAU: f32 = 6.2831853;

// A place in a leaf or petal: 0..1 along it, -1..1 across it at its widest, and its distance from the outline, positive inside.
struct Blade {
    along: f32,
    across: f32,
    depth: f32,
}

// A blade of half-width w(u) = half sqrt(s(u)) with s = 27/4 u^2 (1 - u), pointed at its base and round at its tip, or turned round.
// The distance is that of Taubin 1994: f/|grad f| of f = w^2 - v^2.
fn blade(place: vec2<f32>, axis: vec2<f32>, reach: f32, half: f32, pointed_tip: bool) -> Blade {
    let along = dot(place, axis) / reach;
    let across = dot(place, vec2(-axis.y, axis.x));
    let u = select(along, 1.0 - along, pointed_tip);
    let shape = select(6.75 * u * u * (1.0 - u), -u * u, u < 0.0);
    let slope = select(6.75 * u * (2.0 - 3.0 * u), -2.0 * u, u < 0.0);
    let f = half * half * shape - across * across;
    let gradient = length(vec2(half * half * slope / reach, 2.0 * across));
    return Blade(along, across / half, f / max(gradient, 1e-4));
}

// Lays `paint` over `below` where `depth` is positive; a groove runs along its outline.
fn over(below: f32, paint: f32, depth: f32) -> f32 {
    const EDGE: f32 = 0.006;
    const GROOVE: f32 = 0.012;
    let pressed = below * (1.0 - 0.75 * edge(-GROOVE, 0.0, depth, params.texel));
    return mix(pressed, paint, edge(0.0, EDGE, depth, params.texel));
}

// Uniform in [low, high), another one for each `index`.
fn draw(low: f32, high: f32, seed: u32, index: u32) -> f32 {
    return mix(low, high, unit(hash(seed ^ hash(index))));
}

fn leaf(place: vec2<f32>, axis: vec2<f32>, below: f32, seed: u32) -> f32 {
    const LENGTH: f32 = 0.48;
    const HALF: f32 = 0.085;
    const VEINS: f32 = 9.0;
    let at = blade(place, axis, LENGTH, HALF, true);
    let depth = at.depth + 0.006 * (grain_in(place, vec2(30.0), seed, params.texel) - 0.5);
    // The middle vein and those that leave it, as furrows.
    let middle = ridge(at.across * HALF, 0.006, params.texel);
    let side = VEINS * (at.along - 0.25 * abs(at.across));
    let from_side = (side - round(side)) * LENGTH / VEINS;
    let furrow = max(middle, 0.6 * ridge(from_side, 0.005, params.texel));
    let streaks = grain_in(place, vec2(25.0), seed + 1u, params.texel);
    let paint = (0.5 + 0.2 * streaks + 0.25 * ridge(depth - 0.008, 0.007, params.texel)) * (1.0 - 0.6 * furrow);
    return over(below, paint, depth);
}

fn petal(place: vec2<f32>, axis: vec2<f32>, reach: f32, half: f32, below: f32, seed: u32) -> f32 {
    let at = blade(place, axis, reach, half, false);
    let depth = at.depth + 0.012 * (grain_in(place, vec2(16.0), seed, params.texel) - 0.5);
    if depth < -0.02 - params.texel {
        return below;
    }
    // Veins fan out from the base, as the strokes of the brush do.
    let fan = at.across / max(at.along, 0.1);
    let texel_fan = params.texel / (half * max(at.along, 0.1));
    let streaks = grain_in(vec2(at.along, fan), vec2(2.5, 9.0), seed + 1u, texel_fan);
    let vein = ridge((fan - 0.5 * round(2.0 * fan)) * half, 0.006, params.texel) * (1.0 - edge(0.5, 0.95, at.along, params.texel));
    let rim = ridge(depth - 0.012, 0.010, params.texel);
    let body = 0.3 + 0.35 * streaks + 0.2 * (1.0 - at.along);
    let paint = saturate(mix(body + 0.2 * vein, 1.0, 0.75 * rim));
    return over(below, paint, depth);
}

// Rings of dots, six more in each.
fn centre(place: vec2<f32>, below: f32, seed: u32) -> f32 {
    const RADIUS: f32 = 0.075;
    const SPACING: f32 = 0.0165;
    let radius = length(place);
    let depth = RADIUS - radius + 0.008 * (grain_in(place, vec2(40.0), seed, params.texel) - 0.5);
    let ring = round(radius / SPACING);
    let count = max(6.0 * ring, 1.0);
    let angle = select(0.0, atan2(place.y, place.x), radius > 0.0) / TAU;
    // Each ring starts elsewhere.
    let start = draw(0.0, 1.0, seed, u32(ring));
    let nearest = (round((angle - start) * count) / count + start) * TAU;
    let from_dot = length(place - ring * SPACING * vec2(cos(nearest), sin(nearest)));
    let dab = faded(0.35, 1.0 - edge(0.15 * SPACING, 0.5 * SPACING, from_dot, params.texel), params.texel / SPACING);
    return over(below, 0.45 + 0.55 * dab, depth);
}

fn flower(place: vec2<f32>) -> f32 {
    let turn = TAU / f32(params.petals);
    let start = draw(0.0, TAU, params.seed, 0u);
    var thickness = 0.0;
    for (var index = 0u; index < 2u; index++) {
        // Between two petals, on either side.
        let gap = f32(index * ((params.petals + 1u) / 2u)) + 0.5;
        let angle = start + (gap + draw(-0.15, 0.15, params.seed, 1u + index)) * turn;
        thickness = leaf(place, vec2(cos(angle), sin(angle)), thickness, params.seed + 16u * index);
    }
    for (var index = 0u; index < params.petals; index++) {
        let own = hash(params.seed ^ hash(100u + index));
        let angle = start + (f32(index) + draw(-0.12, 0.12, own, 0u)) * turn;
        let reach = draw(0.36, 0.41, own, 1u);
        // A little wider than its share of the circle.
        let half = min(draw(1.15, 1.4, own, 2u) * 0.66 * reach * tan(min(0.5 * turn, 0.7)), 0.15);
        thickness = petal(place, vec2(cos(angle), sin(angle)), reach, half, thickness, own);
    }
    return centre(place, thickness, params.seed + 40u);
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
            thickness = max(thickness, flower(own));
        }
    }
    drawn[params.first + texel] = thickness;
}
