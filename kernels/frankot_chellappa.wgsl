// Spectrum of the periodic height field whose slopes are nearest to given ones: Z = (-iuP - ivQ)/(u² + v²), Z(0,0) = 0, with
// u, v in radians a texel (Frankot and Chellappa 1988). One thread a frequency. Twin: reference::frankot_chellappa.
//
// P and Q share one transform, F = P + iQ being that of p + iq. Then F·(-i)(u - iv) = (-iuP - ivQ) + (uQ - vP): the inverse
// of the first bracket is real, the height, that of the second imaginary, the part of the slopes that belongs to no surface.
// At the highest frequency of an even size, u stands for π and -π alike; a real field has no derivative there, so u is 0 in
// the numerator (what taking the real part does to -iuP).
#import thread

struct Params {
    width: u32,
    height: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [row][column] of frequencies, F as (real, imaginary)
@group(0) @binding(1) var<storage, read> slope_spectrum: array<vec2<f32>>;
// [row][column] of frequencies, (real, imaginary): its inverse transform has the height in its real part
@group(0) @binding(2) var<storage, read_write> height_spectrum: array<vec2<f32>>;

const SIZE: u32 = 64u;
const PI: f32 = 3.14159265358979;

// Radians a texel of entry `index` of `count`, in (-π, π].
fn frequency(index: u32, count: u32) -> f32 {
    let cycles = select(i32(index), i32(index) - i32(count), 2u * index > count);
    return 2.0 * PI * f32(cycles) / f32(count);
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let at = thread_index(group, groups, local, SIZE);
    if at >= params.width * params.height {
        return;
    }
    if at == 0u {
        height_spectrum[at] = vec2(0.0);
        return;
    }
    let column = at % params.width;
    let row = at / params.width;
    // Rows run downwards, y upwards.
    let wave = vec2(frequency(column, params.width), -frequency(row, params.height));
    let u = select(wave.x, 0.0, 2u * column == params.width);
    let v = select(wave.y, 0.0, 2u * row == params.height);
    let f = slope_spectrum[at];
    // F·(-i)(u - iv) = F·(-v - iu)
    height_spectrum[at] = vec2(f.y * u - f.x * v, -f.x * u - f.y * v) / dot(wave, wave);
}
