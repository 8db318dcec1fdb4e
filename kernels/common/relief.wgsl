// Rays against the height field: linear search, then binary refinement (Policarpo, Oliveira, Comba 2005); soft self-shadow
// (Tatarchuk 2006). Places are in texels: x = column, y = row (downwards), texel centres at whole numbers.
// Twin: reference::relief, exact crossings with the bilinear patches.
#import boundary
#import height_field

// A step of the search covers at most this many texels, so that a crossing is missed only where the ray enters and leaves the
// surface within it.
const STEP: f32 = 0.5;
// Bound of a search. The view's steps get longer where it does not suffice (a relief of 16 texels seen at more than 86
// degrees); blockers beyond it, at least 360 texels away, cast no shadow.
const MAX_STEPS: u32 = 512u;
// Each halves the bracket: 8 make 1/512 texel of STEP, which a last secant step squares.
const REFINEMENTS: u32 = 8u;
// Texel widths that a blocker must stand above the ray to the light. The ray starts on the surface itself, and places rounded
// to 2^-12 texel (at 4096 texels) on slopes up to 4 err by this much; it shortens no shadow by more than tan(theta)/1000.
const BIAS: f32 = 0.001;
// Texels to the nearest blocker; a surface that turns from the light nearer by is left to its own shading.
const NEAREST: f32 = 0.5;
// Directions with a cosine below this are taken for the horizon: nothing is seen from there, and no light comes.
const MIN_COSINE: f32 = 0.001;

// The four texels around a place and how far it lies between them.
struct Cell {
    // upper left, upper right, lower left, lower right
    texels: vec4<u32>,
    fraction: vec2<f32>,
}

struct Hit {
    place: vec2<f32>,
    height: f32,
}

fn cell_at(place: vec2<f32>) -> Cell {
    return cell_of(place, vec2(scene.width, scene.height), 0u);
}

// The same on a plane of `size` that begins at `begin`.
fn cell_of(place: vec2<f32>, size: vec2<u32>, begin: u32) -> Cell {
    let corner = floor(place);
    if all(corner >= vec2(0.0)) && all(corner < vec2<f32>(size) - 1.0) {
        // Most places need no boundary, whose remainders cost more than the rest of a step.
        let texel = begin + u32(corner.y) * size.x + u32(corner.x);
        return Cell(vec4(texel, texel + 1u, texel + size.x, texel + size.x + 1u), place - corner);
    }
    let left = wrap(i32(corner.x), size.x, scene.boundary);
    let right = wrap(i32(corner.x) + 1, size.x, scene.boundary);
    let upper = begin + wrap(i32(corner.y), size.y, scene.boundary) * size.x;
    let lower = begin + wrap(i32(corner.y) + 1, size.y, scene.boundary) * size.x;
    return Cell(vec4(upper + left, upper + right, lower + left, lower + right), place - corner);
}

// Bilinear height; exactly the common height of four equal texels.
fn height_at(place: vec2<f32>) -> f32 {
    let cell = cell_at(place);
    let upper = heights[cell.texels.x] + (heights[cell.texels.y] - heights[cell.texels.x]) * cell.fraction.x;
    let lower = heights[cell.texels.z] + (heights[cell.texels.w] - heights[cell.texels.z]) * cell.fraction.x;
    return upper + (lower - upper) * cell.fraction.y;
}

// Texels by which the place on a ray moves as the ray gains one texel width of height. Rows run against y.
fn run_of(direction: vec3<f32>) -> vec2<f32> {
    return vec2(direction.x, -direction.y) / direction.z;
}

fn march_steps(texels: f32) -> u32 {
    return u32(clamp(ceil(texels / STEP), 1.0, f32(MAX_STEPS)));
}

// Unit normal at a place: bilinear between those of its texels.
fn normal_at(place: vec2<f32>) -> vec3<f32> {
    let cell = cell_at(place);
    let upper = mix(normals[cell.texels.x], normals[cell.texels.y], cell.fraction.x);
    let lower = mix(normals[cell.texels.z], normals[cell.texels.w], cell.fraction.x);
    return normalize(mix(upper, lower, cell.fraction.y).xyz);
}

// Where the ray from `view` through `base` (a place on z = 0) first meets the surface.
fn first_hit(base: vec2<f32>, view: vec3<f32>) -> Hit {
    if scene.displace == 0u {
        return Hit(base, height_at(base));
    }
    let run = run_of(view);
    let depth = scene.highest - scene.lowest;
    let steps = march_steps(depth * length(run));
    // The ray is above the surface at height `above`, and on or below it at `below`.
    var above = scene.highest;
    var below = scene.highest;
    for (var step = 1u; step <= steps; step++) {
        below = scene.highest - depth * (f32(step) / f32(steps));
        if height_at(base + below * run) >= below {
            break;
        }
        above = below;
    }
    for (var step = 0u; step < REFINEMENTS; step++) {
        let middle = 0.5 * (above + below);
        if height_at(base + middle * run) >= middle {
            below = middle;
        } else {
            above = middle;
        }
    }
    // Secant step on the surface's height rather than the ray's: both agree at the crossing, and a flat field is met exactly.
    let height_above = height_at(base + above * run);
    let height_below = height_at(base + below * run);
    let gap_above = max(above - height_above, 0.0);
    let gap_below = max(height_below - below, 0.0);
    let share = gap_below / max(gap_above + gap_below, 1e-20);
    let place = base + (height_below + (height_above - height_below) * share) * run;
    return Hit(place, height_at(place));
}

// Share of a light that a hit sees. A blocker that stands e above the ray at path length d covers e/(d tan(width)) of a light
// of that angular width; the largest cover counts (Tatarchuk 2006: heights above the ray, weighted by nearness). Between two
// grid lines the surface hardly bends, so the cover is largest where the ray crosses one: crossings are where it is looked up,
// which moves with the hit and leaves no steps in the edge of a shadow.
fn visibility(hit: Hit, light: vec3<f32>) -> f32 {
    if light.z < MIN_COSINE {
        return 0.0;
    }
    if scene.shadow == 0u {
        return 1.0;
    }
    let run = run_of(light);
    let rise = scene.highest - hit.height;
    // Height that the ray gains from one column, one row to the next; a light at the zenith crosses none.
    let apart = 1.0 / max(abs(run), vec2(1e-6));
    var gained = NEAREST / max(length(run), 1e-6);
    // How far the place is along the ray from its last column and row.
    let start = hit.place + gained * run;
    let passed = select(ceil(start) - start, start - floor(start), run >= vec2(0.0));
    var next = gained + (1.0 - passed) * apart;
    var cover = 0.0;
    // Nothing stands above the ray where it has gained the highest place.
    for (var crossing = 0u; crossing < MAX_STEPS && gained < rise && cover < 1.0; crossing++) {
        let excess = height_at(hit.place + gained * run) - (hit.height + gained) - BIAS;
        cover = max(cover, excess * light.z / (gained * scene.penumbra));
        gained = min(next.x, next.y);
        next += select(vec2(0.0), apart, next <= vec2(gained));
    }
    return 1.0 - min(cover, 1.0);
}
