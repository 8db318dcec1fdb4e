// The next coarser level of what paint looks like: the mean over the texels that a coarser one covers, for pictures in which a pixel covers
// several. Levels lie one after the other in each buffer, the finest first. What is bare does not count in the means of paint; the spread of
// the normals, which a mean loses, is kept for the roughness (Toksvig 2005; Olano, Baker 2010). One thread a texel of the coarser level.
// Twin: reference::minify.
#import thread

struct Params {
    // columns and rows of the finer and of the coarser level, and where they begin
    fine: vec2<u32>,
    coarse: vec2<u32>,
    fine_begin: u32,
    coarse_begin: u32,
    _pad0: u32,
    _pad1: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [level][row][column]
// rgb: diffuse reflectance; w: coverage
@group(0) @binding(1) var<storage, read_write> painted: array<vec4<f32>>;
// F0 and GGX alpha
@group(0) @binding(2) var<storage, read_write> coats: array<vec2<f32>>;
// unit normal; w: what is added to the square of alpha
@group(0) @binding(3) var<storage, read_write> normals: array<vec4<f32>>;

const SIZE: u32 = 64u;

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    if texel >= params.coarse.x * params.coarse.y {
        return;
    }
    // Finer texels from `low` to `high`, those at the ends in part: a side need not be even. In units of 1/coarse all ends are whole numbers.
    let at = vec2(texel % params.coarse.x, texel / params.coarse.x);
    let low = at * params.fine;
    let high = low + params.fine;
    let first = low / params.coarse;
    let last = (high + params.coarse - 1u) / params.coarse;
    var coverage = 0.0;
    var pigment = vec3(0.0);
    var f0 = 0.0;
    var alpha2 = 0.0;
    // of the painted part, and of all
    var painted_normal = vec3(0.0);
    var normal = vec3(0.0);
    for (var row = first.y; row < last.y; row++) {
        for (var column = first.x; column < last.x; column++) {
            let corner = vec2(column, row) * params.coarse;
            let inside = vec2<f32>(min(corner + params.coarse, high) - max(corner, low)) / vec2<f32>(params.fine);
            let weight = inside.x * inside.y;
            let index = params.fine_begin + row * params.fine.x + column;
            let paint = painted[index];
            let covered = weight * paint.w;
            // A finer mean is as long as its spread leaves it.
            let own = normals[index].xyz / (1.0 + 0.5 * normals[index].w);
            coverage += covered;
            pigment += covered * paint.rgb;
            f0 += covered * coats[index].x;
            alpha2 += covered * coats[index].y * coats[index].y;
            painted_normal += covered * own;
            normal += weight * own;
        }
    }
    let begin = params.coarse_begin + texel;
    if coverage > 0.0 {
        painted[begin] = vec4(pigment / coverage, coverage);
        coats[begin] = vec2(f0, sqrt(alpha2 * coverage)) / coverage;
        normal = painted_normal / coverage;
    } else {
        painted[begin] = vec4(0.0);
        coats[begin] = coats[params.fine_begin + first.y * params.fine.x + first.x];
    }
    let along = length(normal);
    normals[begin] = vec4(normal / along, max(2.0 * (1.0 - along) / along, 0.0));
}
