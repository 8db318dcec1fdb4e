// Means of an environment over GGX lobes at n = v = R (Karis 2013), for the directions R of an octahedral map and four roughnesses:
// sum L w / sum w, w = D(n.h) (n.l) over all texels of the source by their solid angles. Nothing is sampled at random: a small bright sun
// is in each sum with all its light. With |n - l|^2 = 4 s, (n.h)^2 = 1 - s, D is in proportion to 1 / (s + alpha^2 (1 - s))^2; at
// alpha = 1 the weight is the cosine, and the mean the irradiance over pi. One thread four texels of some rows.
// Twin: reference::environment.
#import environment
#import thread

struct Params {
    // alpha^2 of four levels, from first_level
    alpha2: vec4<f32>,
    // columns and rows of the source
    source_size: vec2<u32>,
    // columns and rows of a level
    size: u32,
    first_level: u32,
    // rows of the levels to be made
    first_row: u32,
    rows: u32,
    _pad0: u32,
    _pad1: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [row][column], equirectangular, linear RGB
@group(0) @binding(1) var<storage, read> source: array<vec4<f32>>;
// [row], sine and cosine of the elevation, solid angle of a texel
@group(0) @binding(2) var<storage, read> source_rows: array<vec4<f32>>;
// [column], sine and cosine of the azimuth
@group(0) @binding(3) var<storage, read> source_columns: array<vec2<f32>>;
// [level][row][column], octahedral, linear RGB, w = 0
@group(0) @binding(4) var<storage, read_write> levels: array<vec4<f32>>;

const SIZE: u32 = 64u;
// Texels of a thread, one after the other: what is loaded serves all of them.
const TEXELS: u32 = 4u;

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let first = TEXELS * thread_index(group, groups, local, SIZE);
    let count = params.rows * params.size;
    if first >= count {
        return;
    }
    // Columns: texels.
    var n: mat4x3<f32>;
    for (var texel = 0u; texel < TEXELS; texel++) {
        let place = vec2((first + texel) % params.size, params.first_row + (first + texel) / params.size);
        n[texel] = octahedral_direction((vec2<f32>(place) + 0.5) / f32(params.size));
    }
    let n_of = transpose(n);
    // Columns: texels, rows: levels; light and its weight.
    var red = mat4x4<f32>();
    var green = mat4x4<f32>();
    var blue = mat4x4<f32>();
    var weights = mat4x4<f32>();
    for (var row = 0u; row < params.source_size.y; row++) {
        let circle = source_rows[row];
        let up = n_of[1] - circle.x;
        let up2 = up * up;
        // Sums of a row by themselves: numbers of like magnitude are added, and few at a time.
        var row_red = mat4x4<f32>();
        var row_green = mat4x4<f32>();
        var row_blue = mat4x4<f32>();
        var row_weights = mat4x4<f32>();
        for (var column = 0u; column < params.source_size.x; column++) {
            let across = circle.y * source_columns[column];
            let x = n_of[0] - across.x;
            let z = n_of[2] - across.y;
            let s = 0.25 * (x * x + z * z + up2);
            let cosine = max(1.0 - 2.0 * s, vec4(0.0));
            // At most 1, so that no sum overflows.
            let a = params.alpha2 / (s.x + params.alpha2 * (1.0 - s.x));
            let b = params.alpha2 / (s.y + params.alpha2 * (1.0 - s.y));
            let c = params.alpha2 / (s.z + params.alpha2 * (1.0 - s.z));
            let d = params.alpha2 / (s.w + params.alpha2 * (1.0 - s.w));
            let weight = mat4x4(cosine.x * a * a, cosine.y * b * b, cosine.z * c * c, cosine.w * d * d);
            let light = source[row * params.source_size.x + column];
            row_red += light.x * weight;
            row_green += light.y * weight;
            row_blue += light.z * weight;
            row_weights += weight;
        }
        red += circle.z * row_red;
        green += circle.z * row_green;
        blue += circle.z * row_blue;
        weights += circle.z * row_weights;
    }
    for (var texel = 0u; texel < min(TEXELS, count - first); texel++) {
        for (var level = 0u; level < 4u; level++) {
            let place = ((params.first_level + level) * params.size + params.first_row) * params.size + first + texel;
            levels[place] = vec4(vec3(red[texel][level], green[texel][level], blue[texel][level]) / weights[texel][level], 0.0);
        }
    }
}
