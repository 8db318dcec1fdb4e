// Drops of all sizes: one at most in each cell of five lattices, each twice as fine as the one before, all covering about equal parts.
// Twin: reference::pattern.
#import pattern_marks

const SPATTER_LEVELS: u32 = 5u;

struct SpatterFrame {
    // points of the coarsest lattice along the edges of the plane that repeats
    lattice: vec2<u32>,
    // lengths of these edges
    edges: vec2<f32>,
    // cosine and sine of the direction that drops are drawn out along
    turn: vec2<f32>,
}

// Radii of drops, in lattice spacings.
const SMALL: f32 = 0.25;
const LARGE: f32 = 0.52;
// Mean area of a drop, in lattice cells: pi times the mean of the squared radius.
const DROP_AREA: f32 = 0.4848;
// Mean thickness over a drop.
const DROP_THICKNESS: f32 = 0.68;

// Thickness of a drop of `radius` at `apart` from its middle.
fn drop_at(apart: vec2<f32>, radius: f32, axis: vec2<f32>, stretch: f32, texel: f32) -> f32 {
    let distance = length(vec2(dot(apart, axis) / stretch, dot(apart, vec2(-axis.y, axis.x)) * stretch));
    // A drop of less than a texel is drawn as a thinner one of about a texel.
    let least = max(radius, 0.6 * texel);
    let part = distance / least;
    let dome = 1.0 - 0.45 * min(part * part, 1.0);
    let thinned = radius / least;
    return thinned * thinned * dome * edge(0.0, 0.18 * least, least - distance, texel);
}

// Thickness at `place`, 0..1 along both edges, with about `cover` of the plane covered.
fn spatter(place: vec2<f32>, frame: SpatterFrame, cover: f32, seed: u32, texel: f32) -> f32 {
    // What each level leaves bare, and the chance of a drop in a lattice cell.
    let left = pow(1.0 - cover, 1.0 / f32(SPATTER_LEVELS));
    let chance = -log(left) / DROP_AREA;
    var bare = 1.0;
    for (var level = 0u; level < SPATTER_LEVELS; level++) {
        let period = frame.lattice << vec2(level);
        let spacing = frame.edges / vec2<f32>(period);
        let mean_spacing = sqrt(spacing.x * spacing.y);
        // Drops are seen from four texels a spacing on, and as a veil up to two.
        let seen = saturate(2.0 - 4.0 * texel / min(spacing.x, spacing.y));
        let at = place * vec2<f32>(period);
        let nearest = vec2<i32>(floor(at));
        var product = 1.0;
        for (var neighbour = 0; neighbour < 9; neighbour++) {
            let point = nearest + vec2(neighbour % 3 - 1, neighbour / 3 - 1);
            var bits = lattice_bits(point, period, seed + level);
            if seen == 0.0 || unit(bits) >= chance {
                continue;
            }
            var draws: array<f32, 5>;
            for (var index = 0; index < 5; index++) {
                bits = hash(bits + 1u);
                draws[index] = unit(bits);
            }
            let apart = (at - vec2<f32>(point) - vec2(draws[0], draws[1])) * spacing;
            let radius = mix(SMALL, LARGE, draws[2]) * mean_spacing;
            let angle = draws[3] - 0.5;
            let turned = vec2(cos(angle), sin(angle));
            let axis = vec2(turned.x * frame.turn.x - turned.y * frame.turn.y, turned.x * frame.turn.y + turned.y * frame.turn.x);
            product *= 1.0 - drop_at(apart, radius, axis, 1.0 + 0.25 * draws[4], texel);
        }
        bare *= mix(1.0 - (1.0 - left) * DROP_THICKNESS, product, seen);
    }
    return 1.0 - bare;
}
