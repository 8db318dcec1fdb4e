// A procedural pattern: the thickness drawn at each texel, 0 (bare) to 1, in cells that repeat over the plane. One thread a texel.
// Cell coordinates: origin in the middle of the cell, x right, y up, its shorter edge 1 long (model::Placement); pattern coordinates:
// the same, of the pattern's own frame. Nothing is drawn finer than a texel: edges are widened to one, and what is thinner fades.
// Splash, flower and brush stroke lie within REACH of their middle and are drawn wherever a repetition of them reaches; stripes, noise
// and spatter fill the cell, with whole periods along its edges.
// Twin: reference::pattern.
#import thread
#import pattern_marks
#import splash
#import flower
#import brush
#import spatter

struct Params {
    // columns and rows of texels: of the plane, and of a cell
    size: vec2<u32>,
    cell: vec2<f32>,
    // lengths of the cell's edges, the shorter one 1
    edges: vec2<f32>,
    // model::Placement: cell coordinates, cosine and sine, factor
    offset: vec2<f32>,
    turn: vec2<f32>,
    scale: f32,
    // width of a texel, pattern coordinates
    texel: f32,
    // repetitions that may reach a place, to either side of the nearest
    repeats: vec2<u32>,
    // lattice points along the cell's edges
    lattice: vec2<u32>,
    // stripes crossed along the cell's edges
    wave: vec2<f32>,
    // model::Pattern::code
    pattern: u32,
    seed: u32,
    petals: u32,
    // drawn thickness, width or covered part, whichever the pattern has
    amount: f32,
    // index of the layer's first texel
    first: u32,
    _pad: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [row][column + 1 at the end of all], of a splash: index of the first shape near each of its bins
@group(0) @binding(1) var<storage, read> bins: array<u32>;
// [bin][shape], of a splash
@group(0) @binding(2) var<storage, read> shapes: array<Capsule>;
// [layer][row][column], drawn thickness 0..1
@group(0) @binding(3) var<storage, read_write> drawn: array<f32>;

const SIZE: u32 = 64u;
const SPLASH: u32 = 1u;
const BRUSH: u32 = 2u;
const FLOWER: u32 = 3u;
const SPATTER: u32 = 4u;
const STRIPES: u32 = 5u;
const NOISE: u32 = 6u;

// Where splash, flower and brush stroke end, pattern coordinates.
const REACH: f32 = 0.52;

fn splash_at(place: vec2<f32>) -> f32 {
    let bin = splash_bin(place);
    var sum = 0.0;
    for (var index = bins[bin]; index < bins[bin + 1u]; index++) {
        sum += flow(outline(place, shapes[index]));
    }
    return splash(place, joined(sum), params.seed, params.texel);
}

// The thickest of the repetitions that reach `place`, in cell coordinates from the middle of the nearest.
fn repeated(place: vec2<f32>) -> f32 {
    let repeats = vec2<i32>(params.repeats);
    var thickness = 0.0;
    for (var j = -repeats.y; j <= repeats.y; j++) {
        for (var i = -repeats.x; i <= repeats.x; i++) {
            let apart = (place - vec2(f32(i), f32(j)) * params.edges) / params.scale;
            let own = vec2(dot(apart, params.turn), dot(apart, vec2(-params.turn.y, params.turn.x)));
            if dot(own, own) > (REACH + params.texel) * (REACH + params.texel) {
                continue;
            }
            var mark = 0.0;
            switch params.pattern {
                case SPLASH: {
                    mark = splash_at(own);
                }
                case FLOWER: {
                    mark = flower(own, params.petals, params.seed, params.texel);
                }
                default: {
                    mark = brush(own, params.amount, params.seed, params.texel);
                }
            }
            thickness = max(thickness, mark);
        }
    }
    return thickness;
}

// Painted part of a stripe pattern, `painted` of each period around whole phases, averaged with a parabola over 0.06 periods or more.
fn stripes(phase: f32, painted: f32, texel_periods: f32) -> f32 {
    const SOFT: f32 = 0.06;
    let reach = clamp(texel_periods, SOFT, 1.0);
    let from_middle = phase - round(phase);
    var part = 0.0;
    for (var k = -1; k <= 1; k++) {
        let x = from_middle - f32(k);
        part += step_over(x + 0.5 * painted, reach) - step_over(x - 0.5 * painted, reach);
    }
    // Beyond one period nothing is left of them.
    return mix(saturate(part), painted, saturate(texel_periods - 1.0));
}

// Octaves of noise, each twice as fine and half as strong as the one before, stretched.
fn clouds(place: vec2<f32>) -> f32 {
    const OCTAVES: u32 = 6u;
    var sum = 0.0;
    var whole = 0.0;
    for (var octave = 0u; octave < OCTAVES; octave++) {
        let share = 1.0 / f32(1u << octave);
        let period = params.lattice << vec2(octave);
        let spacing = params.edges / (vec2<f32>(period) * params.scale);
        let value = noise(place * vec2<f32>(period), period, params.seed + octave);
        sum += share * faded(value, params.texel / min(spacing.x, spacing.y));
        whole += share;
    }
    return smoothstep(0.2, 0.8, sum / whole);
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    if texel >= params.size.x * params.size.y {
        return;
    }
    let centre = vec2(f32(texel % params.size.x), f32(params.size.y - 1u - texel / params.size.x)) + 0.5;
    let in_cell = centre - params.cell * floor(centre / params.cell) - 0.5 * params.cell;
    let moved = in_cell / min(params.cell.x, params.cell.y) - params.offset;
    let place = moved - params.edges * round(moved / params.edges);
    let part = place / params.edges;
    var thickness = params.amount;
    switch params.pattern {
        case SPLASH, FLOWER, BRUSH: {
            thickness = repeated(place);
        }
        case STRIPES: {
            let periods = params.wave / params.edges;
            thickness = stripes(dot(part, params.wave), params.amount, length(periods) * params.scale * params.texel);
        }
        case SPATTER: {
            let frame = SpatterFrame(params.lattice, params.edges / params.scale, params.turn);
            thickness = spatter(part + 0.5, frame, params.amount, params.seed, params.texel);
        }
        case NOISE: {
            thickness = clouds(part + 0.5);
        }
        default: {}
    }
    drawn[params.first + texel] = thickness;
}
