// One pass of Stockham's autosorting transform along one axis of a complex field: one factor of the axis' length.
// With n = L·r·M, L done by earlier passes and r this pass' factor, and w = exp(-2πi/n) (its conjugate for the inverse):
//   out[(k + L·c)·M + j] = scale·Σ_s w^(s·(k + L·c)·M)·in[k·r·M + s·M + j],  k < L, c < r, j < M, s < r.
// After L = 1 … n this is X_k = Σ_j x_j w^(jk) in natural order (Van Loan 1992, ch. 1.7, for any factor).
// One thread an output value, a direct sum of r terms. Twin: reference::fft.
#import thread

struct Params {
    // first output value of this dispatch, and the one past its last
    first: u32,
    end: u32,
    // values along the axis (n), and the distance of two that are neighbours along it
    length: u32,
    stride: u32,
    // L, r, M
    done: u32,
    radix: u32,
    rest: u32,
    // 1 forward, -1 inverse
    sign: f32,
    scale: f32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [k] of the axis' length, exp(-2πi k/n) as (real, imaginary)
@group(0) @binding(1) var<storage, read> twiddles: array<vec2<f32>>;
// [row][column], (real, imaginary)
@group(0) @binding(2) var<storage, read> source: array<vec2<f32>>;
// [row][column], (real, imaginary)
@group(0) @binding(3) var<storage, read_write> result: array<vec2<f32>>;

const SIZE: u32 = 64u;

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let at = params.first + thread_index(group, groups, local, SIZE);
    if at >= params.end {
        return;
    }
    let along = (at / params.stride) % params.length;
    let line = at - along * params.stride;
    let frequency = along / params.rest;
    let j = along % params.rest;
    let k = frequency % params.done;

    var value = line + (k * params.radix * params.rest + j) * params.stride;
    let value_step = params.rest * params.stride;
    var angle = 0u;
    let angle_step = frequency * params.rest;
    var sum = vec2(0.0);
    for (var s = 0u; s < params.radix; s++) {
        let x = source[value];
        let w = twiddles[angle] * vec2(1.0, params.sign);
        sum += vec2(x.x * w.x - x.y * w.y, x.x * w.y + x.y * w.x);
        value += value_step;
        angle += angle_step;
        angle -= select(0u, params.length, angle >= params.length);
    }
    result[at] = params.scale * sum;
}
