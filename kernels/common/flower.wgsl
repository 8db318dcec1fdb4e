// A flower seen from above: two leaves, petals that overlap, a centre of dots. Each is laid over what lies below it, which it presses
// aside.
// Twin: reference::pattern.
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
fn over(below: f32, paint: f32, depth: f32, texel: f32) -> f32 {
    const EDGE: f32 = 0.006;
    const GROOVE: f32 = 0.012;
    let pressed = below * (1.0 - 0.75 * edge(-GROOVE, 0.0, depth, texel));
    return mix(pressed, paint, edge(0.0, EDGE, depth, texel));
}

// Uniform in [low, high), another one for each `index`.
fn draw(low: f32, high: f32, seed: u32, index: u32) -> f32 {
    return mix(low, high, unit(hash(seed ^ hash(index))));
}

fn leaf(place: vec2<f32>, axis: vec2<f32>, below: f32, seed: u32, texel: f32) -> f32 {
    const LENGTH: f32 = 0.48;
    const HALF: f32 = 0.085;
    const VEINS: f32 = 9.0;
    let at = blade(place, axis, LENGTH, HALF, true);
    let depth = at.depth + 0.006 * (grain(place, vec2(30.0), seed, texel) - 0.5);
    // The middle vein and those that leave it, as furrows.
    let middle = ridge(at.across * HALF, 0.006, texel);
    let side = VEINS * (at.along - 0.25 * abs(at.across));
    let from_side = (side - round(side)) * LENGTH / VEINS;
    let furrow = max(middle, 0.6 * ridge(from_side, 0.005, texel));
    let streaks = grain(place, vec2(25.0), seed + 1u, texel);
    let paint = (0.5 + 0.2 * streaks + 0.25 * ridge(depth - 0.008, 0.007, texel)) * (1.0 - 0.6 * furrow);
    return over(below, paint, depth, texel);
}

fn petal(place: vec2<f32>, axis: vec2<f32>, reach: f32, half: f32, below: f32, seed: u32, texel: f32) -> f32 {
    let at = blade(place, axis, reach, half, false);
    let depth = at.depth + 0.012 * (grain(place, vec2(16.0), seed, texel) - 0.5);
    if depth < -0.02 - texel {
        return below;
    }
    // Veins fan out from the base, as the strokes of the brush do.
    let fan = at.across / max(at.along, 0.1);
    let texel_fan = texel / (half * max(at.along, 0.1));
    let streaks = grain(vec2(at.along, fan), vec2(2.5, 9.0), seed + 1u, texel_fan);
    let vein = ridge((fan - 0.5 * round(2.0 * fan)) * half, 0.006, texel) * (1.0 - edge(0.5, 0.95, at.along, texel));
    let rim = ridge(depth - 0.012, 0.010, texel);
    let body = 0.3 + 0.35 * streaks + 0.2 * (1.0 - at.along);
    let paint = saturate(mix(body + 0.2 * vein, 1.0, 0.75 * rim));
    return over(below, paint, depth, texel);
}

// Rings of dots, six more in each.
fn centre(place: vec2<f32>, below: f32, seed: u32, texel: f32) -> f32 {
    const RADIUS: f32 = 0.075;
    const SPACING: f32 = 0.0165;
    let radius = length(place);
    let depth = RADIUS - radius + 0.008 * (grain(place, vec2(40.0), seed, texel) - 0.5);
    let ring = round(radius / SPACING);
    let count = max(6.0 * ring, 1.0);
    let angle = select(0.0, atan2(place.y, place.x), radius > 0.0) / TAU;
    // Each ring starts elsewhere.
    let start = draw(0.0, 1.0, seed, u32(ring));
    let nearest = (round((angle - start) * count) / count + start) * TAU;
    let from_dot = length(place - ring * SPACING * vec2(cos(nearest), sin(nearest)));
    let dot_paint = 1.0 - edge(0.15 * SPACING, 0.5 * SPACING, from_dot, texel);
    return over(below, 0.45 + 0.55 * dot_paint, depth, texel);
}

// Thickness at `place`.
fn flower(place: vec2<f32>, petals: u32, seed: u32, texel: f32) -> f32 {
    let step = TAU / f32(petals);
    let start = draw(0.0, TAU, seed, 0u);
    var thickness = 0.0;
    for (var index = 0u; index < 2u; index++) {
        // Between two petals, on either side.
        let gap = f32(index * ((petals + 1u) / 2u)) + 0.5;
        let angle = start + (gap + draw(-0.15, 0.15, seed, 1u + index)) * step;
        thickness = leaf(place, vec2(cos(angle), sin(angle)), thickness, seed + 16u * index, texel);
    }
    for (var index = 0u; index < petals; index++) {
        let own = hash(seed ^ hash(100u + index));
        let angle = start + (f32(index) + draw(-0.12, 0.12, own, 0u)) * step;
        let reach = draw(0.36, 0.41, own, 1u);
        // A little wider than its share of the circle.
        let half = min(draw(1.15, 1.4, own, 2u) * 0.66 * reach * tan(min(0.5 * step, 0.7)), 0.15);
        thickness = petal(place, vec2(cos(angle), sin(angle)), reach, half, thickness, own, texel);
    }
    return centre(place, thickness, seed + 40u, texel);
}
