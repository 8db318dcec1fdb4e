// Where a procedural pattern is drawn (model::Placement): in cells that repeat over the plane. Cell coordinates: origin in the middle
// of the cell, x right, y up, its shorter edge 1 long; pattern coordinates: the same, of the pattern's own frame.
#import thread

struct Params {
    // columns and rows of texels: of the plane, and of a cell
    size: vec2<u32>,
    cell: vec2<f32>,
    // lengths of the cell's edges, the shorter one 1
    edges: vec2<f32>,
    // right and up, cell coordinates
    offset: vec2<f32>,
    // cosine and sine of the rotation
    turn: vec2<f32>,
    // factor from pattern to cell coordinates
    scale: f32,
    // width of a texel, pattern coordinates
    texel: f32,
    // repetitions that may reach a place, to either side of the nearest
    repeats: vec2<u32>,
    // lattice points along the cell's edges
    lattice: vec2<u32>,
    // stripes crossed along the cell's edges
    wave: vec2<f32>,
    seed: u32,
    petals: u32,
    // drawn thickness, width or covered part, whichever the pattern has
    amount: f32,
    // index of the layer's first texel
    first: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [layer][row][column], drawn thickness 0..1
@group(0) @binding(1) var<storage, read_write> drawn: array<f32>;

const SIZE: u32 = 64u;

// Distance from its middle at which a pattern that does not fill its cell ends, pattern coordinates.
const REACH: f32 = 0.49;

fn outside(texel: u32) -> bool {
    return texel >= params.size.x * params.size.y;
}

// The texel's centre in cell coordinates, from the middle of the nearest repetition.
fn place_of(texel: u32) -> vec2<f32> {
    let centre = vec2(f32(texel % params.size.x), f32(params.size.y - 1u - texel / params.size.x)) + 0.5;
    let in_cell = centre - params.cell * floor(centre / params.cell) - 0.5 * params.cell;
    let moved = in_cell / min(params.cell.x, params.cell.y) - params.offset;
    return moved - params.edges * round(moved / params.edges);
}

// How many repetitions may reach a place.
fn repetitions() -> u32 {
    return (2u * params.repeats.x + 1u) * (2u * params.repeats.y + 1u);
}

// The place in pattern coordinates of one of them.
fn in_repetition(place: vec2<f32>, index: u32) -> vec2<f32> {
    let columns = 2u * params.repeats.x + 1u;
    let which = vec2<f32>(vec2<i32>(vec2(index % columns, index / columns)) - vec2<i32>(params.repeats));
    let apart = (place - which * params.edges) / params.scale;
    return vec2(dot(apart, params.turn), dot(apart, vec2(-params.turn.y, params.turn.x)));
}

// Whether a place in pattern coordinates lies beyond the pattern and its edge, which is widened with the texel.
fn beyond(place: vec2<f32>) -> bool {
    let reach = REACH + 0.75 * params.texel;
    return dot(place, place) > reach * reach;
}
