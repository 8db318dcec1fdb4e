// Look-ups in a prefiltered environment (model::environment): levels of octahedral maps, and the table of directional albedos.
// They give texels and weights, so that maps may be buffers or textures. Twin: reference::environment.

// Four texels (column, row) and their weights, which sum to 1.
struct Bilinear {
    texels: array<vec2<u32>, 4>,
    weights: vec4<f32>,
}

fn bilinear_weights(part: vec2<f32>) -> vec4<f32> {
    let rest = 1.0 - part;
    return vec4(rest.x * rest.y, part.x * rest.y, rest.x * part.y, part.x * part.y);
}

// Place on the unit square of a direction of any length but 0 (Engelhardt, Dachsbacher 2008): the sphere on the octahedron
// |x| + |y| + |z| = 1, seen along y, the half below folded out over the edges. x is to the right, z downwards.
fn octahedral_place(direction: vec3<f32>) -> vec2<f32> {
    let d = direction / (abs(direction.x) + abs(direction.y) + abs(direction.z));
    let folded = (1.0 - abs(d.zx)) * select(vec2(-1.0), vec2(1.0), d.xz >= vec2(0.0));
    return 0.5 + 0.5 * select(folded, d.xz, d.y >= 0.0);
}

// The unit vector of a place on the unit square.
fn octahedral_direction(place: vec2<f32>) -> vec3<f32> {
    let p = 2.0 * place - 1.0;
    let y = 1.0 - abs(p.x) - abs(p.y);
    let unfolded = p - sign(p) * max(-y, 0.0);
    return normalize(vec3(unfolded.x, y, unfolded.y));
}

// The texel next to an edge of an octahedral map is beyond that edge the one that it is folded onto: mirrored along the edge.
fn octahedral_texel(texel: vec2<i32>, size: i32) -> vec2<u32> {
    var inside = texel;
    if inside.x < 0 || inside.x >= size {
        inside = vec2(clamp(inside.x, 0, size - 1), size - 1 - inside.y);
    }
    if inside.y < 0 || inside.y >= size {
        inside = vec2(size - 1 - inside.x, clamp(inside.y, 0, size - 1));
    }
    return vec2<u32>(inside);
}

// Where a level of size x size texels is read for a direction; continuous over the whole sphere.
fn octahedral_bilinear(direction: vec3<f32>, size: u32) -> Bilinear {
    let place = octahedral_place(direction) * f32(size) - 0.5;
    let first = vec2<i32>(floor(place));
    let count = i32(size);
    let texels = array(
        octahedral_texel(first, count),
        octahedral_texel(first + vec2(1, 0), count),
        octahedral_texel(first + vec2(0, 1), count),
        octahedral_texel(first + vec2(1, 1), count),
    );
    return Bilinear(texels, bilinear_weights(place - floor(place)));
}

// Two levels and how much of the upper one.
struct EnvironmentLevels {
    lower: u32,
    upper: u32,
    part: f32,
}

// Levels between which a roughness lies; what is smoother than the smoothest counts as that.
fn environment_levels(roughness: f32, levels: u32) -> EnvironmentLevels {
    let last = levels - 1u;
    let level = clamp(f32(last) + log2(roughness) / 0.75, 0.0, f32(last));
    let lower = min(u32(level), last);
    return EnvironmentLevels(lower, min(lower + 1u, last), level - f32(lower));
}

// Where the table [roughness][cosine] of directional albedos is read, size x size entries: columns by the cosine between normal and
// view. An entry is (scale, bias) of F0, the albedo F0 scale + bias.
fn albedo_bilinear(roughness: f32, cosine: f32, size: u32) -> Bilinear {
    let place = sqrt(saturate(vec2(cosine, roughness))) * f32(size - 1u);
    let first = min(vec2<u32>(place), vec2(size - 2u));
    let texels = array(first, first + vec2(1u, 0u), first + vec2(0u, 1u), first + vec2(1u, 1u));
    return Bilinear(texels, bilinear_weights(place - vec2<f32>(first)));
}
