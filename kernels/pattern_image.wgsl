// The thickness that an image draws at each texel, in cells that repeat over the plane. One thread a texel.
// The image's pixels around the texel are averaged with a tent along each of its axes that reaches one pixel, or one texel if that is
// more: bilinear interpolation or an average over the area. Around the image the plane is bare; where the image reaches from edge to
// edge of its cell, it goes on with its other end. The thickest of the repetitions that reach a texel counts.
// Twin: reference::pattern_image.
#import thread

struct Params {
    // columns and rows: of the plane, and of the image
    size: vec2<u32>,
    image_size: vec2<u32>,
    // texels of a cell
    cell: vec2<f32>,
    // texels, right and up
    offset: vec2<f32>,
    // pixels along the image's axes, right and down in it, for a texel to the right (x, y) and up (z, w)
    axes: vec4<f32>,
    // reach of the tent along the image's axes, pixels
    reach: vec2<f32>,
    // repetitions that may reach a place, to either side of the nearest
    repeats: vec2<u32>,
    // 1 along each axis of the image that goes on with its other end
    closed: vec2<u32>,
    // index of the layer's first texel
    first: u32,
    _pad: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [row][column], drawn thickness 0..1
@group(0) @binding(1) var<storage, read> image: array<f32>;
// [layer][row][column], drawn thickness 0..1
@group(0) @binding(2) var<storage, read_write> drawn: array<f32>;

const SIZE: u32 = 64u;

// The pixels that a tent around `middle` covers along one axis: the first, the one after the last, and the sum of all their weights.
struct Span {
    first: i32,
    end: i32,
    sum: f32,
}

// Sum of the tent's weights at 0, 1, 2... beyond a distance of `start` < 1 from its middle.
fn half_sum(start: f32, reach: f32) -> f32 {
    let count = ceil(reach - start);
    return count * (1.0 - (start + 0.5 * (count - 1.0)) / reach);
}

fn span_at(middle: f32, reach: f32, pixels: u32, closed: u32) -> Span {
    let left = floor(middle);
    let sum = half_sum(middle - left, reach) + half_sum(left + 1.0 - middle, reach);
    var first = i32(floor(middle - reach)) + 1;
    var end = i32(ceil(middle + reach));
    if closed == 0u {
        first = max(first, 0);
        end = min(end, i32(pixels));
    }
    return Span(first, end, sum);
}

// The mean around a place of the image, in pixels, centres at whole numbers.
fn mean_around(place: vec2<f32>) -> f32 {
    let columns = span_at(place.x, params.reach.x, params.image_size.x, params.closed.x);
    let rows = span_at(place.y, params.reach.y, params.image_size.y, params.closed.y);
    let width = i32(params.image_size.x);
    let height = i32(params.image_size.y);
    var sum = 0.0;
    for (var row = rows.first; row < rows.end; row++) {
        let start = ((row % height + height) % height) * width;
        var row_sum = 0.0;
        for (var column = columns.first; column < columns.end; column++) {
            let weight = max(1.0 - abs(f32(column) - place.x) / params.reach.x, 0.0);
            row_sum += weight * image[start + (column % width + width) % width];
        }
        sum += max(1.0 - abs(f32(row) - place.y) / params.reach.y, 0.0) * row_sum;
    }
    return sum / (columns.sum * rows.sum);
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    if texel >= params.size.x * params.size.y {
        return;
    }
    let centre = vec2(f32(texel % params.size.x), f32(params.size.y - 1u - texel / params.size.x)) + 0.5;
    let in_cell = centre - params.cell * floor(centre / params.cell) - 0.5 * params.cell;
    let moved = in_cell - params.offset;
    let nearest = moved - params.cell * round(moved / params.cell);
    let middle = 0.5 * vec2<f32>(params.image_size) - 0.5;
    let repeats = vec2<i32>(params.repeats);
    var thickness = 0.0;
    for (var j = -repeats.y; j <= repeats.y; j++) {
        for (var i = -repeats.x; i <= repeats.x; i++) {
            let apart = nearest - vec2(f32(i), f32(j)) * params.cell;
            thickness = max(thickness, mean_around(middle + apart.x * params.axes.xy + apart.y * params.axes.zw));
        }
    }
    drawn[params.first + texel] = thickness;
}
