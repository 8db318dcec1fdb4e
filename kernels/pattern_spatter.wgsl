// Drawn thickness of drops of all sizes: one at most in each cell of five lattices, each lattice twice as fine as the one before, all
// covering about equal parts. One thread a texel.
// Twin: reference::pattern.
#import pattern_plane
#import pattern_marks

const LEVELS: u32 = 5u;
// Radii of drops, in spacings of the lattice, the narrower of the two: with what it is drawn out and widened by, no drop reaches
// farther than one.
const SMALL: f32 = 0.27;
const LARGE: f32 = 0.5;
// Mean area of a drop, in squares of that: pi times the mean of the squared radius.
const DROP_AREA: f32 = 0.4795;
// Mean thickness over a drop.
const DROP_THICKNESS: f32 = 0.67;

// Two uniform numbers in [0, 1) from 32 random bits.
fn halves(bits: u32) -> vec2<f32> {
    return vec2(f32(bits & 0xffffu), f32(bits >> 16u)) * (1.0 / 65536.0);
}

// Thickness at `apart` from the middle of a drop, pattern coordinates.
fn drop_at(apart: vec2<f32>, spacing: f32, bits: u32) -> f32 {
    let draws = halves(bits);
    let radius = mix(SMALL, LARGE, draws.x) * spacing;
    // Drawn out a little, along nearly the same direction all.
    let stretch = 1.0 + 0.15 * fract(draws.x * 256.0);
    let slant = draws.y - 0.5;
    let axis = (params.turn + slant * vec2(-params.turn.y, params.turn.x)) / sqrt(1.0 + slant * slant);
    let distance = length(vec2(dot(apart, axis) / stretch, dot(apart, vec2(-axis.y, axis.x)) * stretch));
    // A drop of less than a texel is drawn as a thinner one of about a texel.
    let least = max(radius, 0.6 * params.texel);
    let part = distance / least;
    let dome = 1.0 - 0.45 * min(part * part, 1.0);
    let thinned = radius / least;
    return thinned * thinned * dome * edge(0.0, 0.18 * least, least - distance, params.texel);
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    if outside(texel) {
        return;
    }
    // What each level leaves bare.
    let left = pow(1.0 - params.amount, 1.0 / f32(LEVELS));
    let place = place_of(texel) / params.edges + 0.5;
    var bare = 1.0;
    for (var level = 0u; level < LEVELS; level++) {
        let period = params.lattice << vec2(level);
        let spacing = params.edges / (vec2<f32>(period) * params.scale);
        // The chance of a drop in a cell of the lattice.
        let narrow = min(spacing.x, spacing.y);
        let chance = -log(left) / (DROP_AREA * narrow / max(spacing.x, spacing.y));
        // Drops are seen from four texels a spacing on, and as a veil up to two.
        let seen = saturate(2.0 - 4.0 * params.texel / narrow);
        let at = place * vec2<f32>(period);
        let nearest = floor(at);
        var product = 1.0;
        for (var row = -1; row <= 1; row++) {
            // The place lies in the lattice, so that its neighbours are at most one point outside.
            let row_bits = hash(u32(i32(nearest.y) + row + i32(period.y)) % period.y ^ hash(params.seed + level));
            for (var column = -1; column <= 1; column++) {
                let bits = hash(u32(i32(nearest.x) + column + i32(period.x)) % period.x ^ row_bits);
                if seen > 0.0 && unit(bits) < chance {
                    let apart = at - nearest - vec2(f32(column), f32(row)) - halves(hash(bits + 1u));
                    product *= 1.0 - drop_at(apart * spacing, narrow, hash(bits + 2u));
                }
            }
        }
        bare *= mix(1.0 - (1.0 - left) * DROP_THICKNESS, product, seen);
    }
    drawn[params.first + texel] = 1.0 - bare;
}
