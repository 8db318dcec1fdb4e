// Rays against a periodic height field, exactly: between grid lines a ray runs over one bilinear patch, where the height below it is
// a parabola in what the ray has climbed, and so is the first crossing (Ramsey, Potter, Hansen 2004). Texel centres are the corners of
// cells; a place is a cell and the fraction of it passed, x to the right and y downwards, so that nothing is lost on large planes.

// [row][column], texel widths, positive outwards
@group(0) @binding(1) var<storage, read> heights: array<f32>;

// Bound on the cells that a ray passes over: a relief of 256 texels at 85 degrees along a diagonal has 4139.
const MAX_CELLS: u32 = 8192u;

struct Crossing {
    // whether the ray meets the surface from above
    met: bool,
    // where it meets it, or ends
    cell: vec2<u32>,
    fraction: vec2<f32>,
}

// Texels by which the place on a ray moves as the ray gains one texel width of height. Rows run against y.
fn run_of(direction: vec3<f32>) -> vec2<f32> {
    return vec2(direction.x, -direction.y) / direction.z;
}

// The cell after or before `cell` on an axis of `count`.
fn step_cell(cell: u32, forward: bool, count: u32) -> u32 {
    let after = select(cell + 1u, 0u, cell + 1u == count);
    let before = select(cell, count, cell == 0u) - 1u;
    return select(before, after, forward);
}

// Heights at the upper left, upper right, lower left and lower right corner of a cell.
fn corners_of(cell: vec2<u32>, size: vec2<u32>) -> vec4<f32> {
    let right = step_cell(cell.x, true, size.x);
    let upper = cell.y * size.x;
    let lower = step_cell(cell.y, true, size.y) * size.x;
    return vec4(heights[upper + cell.x], heights[upper + right], heights[lower + cell.x], heights[lower + right]);
}

fn bilinear(corners: vec4<f32>, fraction: vec2<f32>) -> f32 {
    let upper = corners.x + (corners.y - corners.x) * fraction.x;
    let lower = corners.z + (corners.w - corners.z) * fraction.x;
    return upper + (lower - upper) * fraction.y;
}

// The least t in 0..end at which c.x + c.y t + c.z t^2 is no longer negative; -1 if there is none.
fn first_zero(c: vec3<f32>, end: f32) -> f32 {
    if c.x >= 0.0 {
        return 0.0;
    }
    let square = c.y * c.y - 4.0 * c.x * c.z;
    let peaks = c.z < 0.0 && c.y > 0.0 && c.y < -2.0 * c.z * end && square >= 0.0;
    if c.x + end * (c.y + end * c.z) < 0.0 && !peaks {
        return -1.0;
    }
    // The form of the root in which nothing cancels; c.z > 0 in the second.
    let root = sqrt(max(square, 0.0));
    if c.y >= 0.0 {
        return min(-2.0 * c.x / (c.y + root), end);
    }
    return min(0.5 * (root - c.y) / c.z, end);
}

// Follows the ray from `fraction` of `cell` at height z for `reach` texel widths of height, upwards (climb = 1) or downwards
// (climb = -1); its place moves by `run` as it passes one.
fn march(cell: vec2<u32>, fraction: vec2<f32>, z: f32, run: vec2<f32>, climb: f32, reach: f32, size: vec2<u32>) -> Crossing {
    let forward = run >= vec2(0.0);
    // Height passed from one column, one row to the next.
    let apart = 1.0 / max(abs(run), vec2(1e-6));
    var here = cell;
    var at = fraction;
    var corners = corners_of(here, size);
    var left = select(at, 1.0 - at, forward) * apart;
    var passed = 0.0;
    for (var step = 0u; step < MAX_CELLS; step++) {
        let within = min(min(left.x, left.y), reach - passed);
        let right = corners.y - corners.x;
        let down = corners.z - corners.x;
        let twist = (corners.w - corners.z) - right;
        let gap = vec3(
            bilinear(corners, at) - (z + climb * passed),
            (right + twist * at.y) * run.x + (down + twist * at.x) * run.y - climb,
            twist * run.x * run.y,
        );
        let zero = first_zero(gap, within);
        if zero >= 0.0 {
            return Crossing(true, here, clamp(at + zero * run, vec2(0.0), vec2(1.0)));
        }
        at = clamp(at + within * run, vec2(0.0), vec2(1.0));
        passed += within;
        if passed >= reach {
            break;
        }
        // Two corners of the next cell are those of this one.
        if left.x <= left.y {
            here.x = step_cell(here.x, forward.x, size.x);
            at.x = select(1.0, 0.0, forward.x);
            left = vec2(apart.x, left.y - within);
            let column = select(here.x, step_cell(here.x, true, size.x), forward.x);
            let upper = heights[here.y * size.x + column];
            let lower = heights[step_cell(here.y, true, size.y) * size.x + column];
            corners = select(vec4(upper, corners.x, lower, corners.z), vec4(corners.y, upper, corners.w, lower), forward.x);
        } else {
            here.y = step_cell(here.y, forward.y, size.y);
            at.y = select(1.0, 0.0, forward.y);
            left = vec2(left.x - within, apart.y);
            let row = select(here.y, step_cell(here.y, true, size.y), forward.y) * size.x;
            let before = heights[row + here.x];
            let after = heights[row + step_cell(here.x, true, size.x)];
            corners = select(vec4(before, after, corners.xy), vec4(corners.zw, before, after), forward.y);
        }
    }
    return Crossing(false, here, at);
}
