// The sums of lafortune_sums for lobes in the frames of seen normals, fitted to radiance: s_k = c_k (A (k . p_k)^n + rho) with
// p_k = w_i * w_o by components in the frame of the sample's normal, c_k its shading and rho what the lobe changes of the
// diffuse part. All columns are thus the lobe's times c, and c itself is one more, that of rho.
// A masked or unlit sample has c = 0 and s = 0, so that each of its terms is 0.
// One thread four fits and a slice (z). Twin: reference::lafortune_framed, of the whole stage.
#import thread
#import octet
#import lafortune_state
#import lafortune_gram
#import shading_frame

struct Params {
    texels: u32,
    octets: u32,
    // a power of two
    stride: u32,
    // quads of fits in a slice's array
    quads: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [sample, filled up to octets]
@group(0) @binding(1) var<storage, read> directions: array<SampleDirections>;
// [row][texel], unit normals, w = 0
@group(0) @binding(2) var<storage, read> seen_normals: array<vec4<f32>>;
// [octet][texel], halves: cos theta_i times the share of the light
@group(0) @binding(3) var<storage, read> shading: array<vec4<u32>>;
// [octet][texel], halves of either sign: what the lobe is to explain of the mean radiance
@group(0) @binding(4) var<storage, read> residual: array<vec4<u32>>;
// [start][texel]
@group(0) @binding(5) var<storage, read> states: array<FitState>;
// number of fits that still run, then those fits
@group(0) @binding(6) var<storage, read> listed: array<u32>;
// [slice][quad of listed fits]
@group(0) @binding(7) var<storage, read_write> grams: array<Gram>;

const SIZE: u32 = 64u;

// Frames of four fits under one view: normals, 1/(1 + n_z), and the view's components in each.
struct Frames {
    // of the seen normals
    row: u32,
    x: vec4<f32>,
    y: vec4<f32>,
    z: vec4<f32>,
    turn: vec4<f32>,
    view_x: vec4<f32>,
    view_y: vec4<f32>,
    view_z: vec4<f32>,
}

fn frames_of(row: u32, texel: vec4<u32>, view: vec3<f32>) -> Frames {
    var frames: Frames;
    frames.row = row;
    for (var i = 0u; i < FITS; i++) {
        let normal = seen_normals[row * params.texels + texel[i]];
        frames.x[i] = normal.x;
        frames.y[i] = normal.y;
        frames.z[i] = normal.z;
    }
    frames.turn = 1.0 / (1.0 + frames.z);
    let along = frames.x * view.x + frames.y * view.y + frames.z * view.z;
    let turned = (along + view.z) * frames.turn;
    frames.view_x = view.x - frames.x * turned;
    frames.view_y = view.y - frames.y * turned;
    frames.view_z = along;
    return frames;
}

// in_frame for four frames at once.
fn add_sample(gram: ptr<function, Gram>, k: Candidates, frames: Frames, light: vec3<f32>, c: vec4<f32>, s: vec4<f32>) {
    let along = frames.x * light.x + frames.y * light.y + frames.z * light.z;
    let turned = (along + light.z) * frames.turn;
    let px = frames.view_x * (light.x - frames.x * turned);
    let py = frames.view_y * (light.y - frames.y * turned);
    let pz = frames.view_z * along;
    let base = k.x * px + k.y * py + k.z * pz;
    let log_base = log2(max(base, vec4(1e-30)));
    let w = c * select(vec4(0.0), exp2((k.exponent - 1.0) * log_base), base > vec4(0.0));
    let m = w * base;
    let x = w * px;
    let y = w * py;
    let z = w * pz;
    let l = m * log_base * LN_2;
    let r = k.amplitude * m + k.constant * c - s;
    add_columns(gram, m, x, y, z, l, r);
    (*gram).cc += c * c;
    (*gram).cm += c * m;
    (*gram).cx += c * x;
    (*gram).cy += c * y;
    (*gram).cz += c * z;
    (*gram).cl += c * l;
    (*gram).cr += c * r;
}

// One sample of the four fits; samples of a view follow each other in most sources.
fn visit(gram: ptr<function, Gram>, frames: ptr<function, Frames>, k: Candidates, texel: vec4<u32>, sample: u32, c: vec4<f32>, s: vec4<f32>) {
    let at = directions[sample];
    if at.row != (*frames).row {
        *frames = frames_of(at.row, texel, at.view);
    }
    add_sample(gram, k, *frames, at.light, c, s);
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let quad = thread_index(group, groups, local, SIZE);
    let running = listed[0];
    if FITS * quad >= running {
        return;
    }
    var k: Candidates;
    var texel: vec4<u32>;
    for (var i = 0u; i < FITS; i++) {
        // The last quad is filled up with its last fit.
        let fit = listed[1u + min(FITS * quad + i, running - 1u)];
        texel[i] = fit % params.texels;
        let candidate = states[fit].candidate;
        k.x[i] = candidate.x;
        k.y[i] = candidate.y;
        k.z[i] = candidate.z;
        k.exponent[i] = candidate.w;
        k.amplitude[i] = states[fit].amplitude;
        k.constant[i] = states[fit].constant;
    }
    var gram = Gram();
    var frames: Frames;
    frames.row = 0xffffffffu;
    let end = min((group.z + 1u) * SLICE, (params.octets + params.stride - 1u) / params.stride);
    for (var index = group.z * SLICE; index < end; index++) {
        let octet = visited(index, params.stride, params.octets);
        let at = octet * params.texels + texel;
        let a = unpack_octet(shading[at.x]);
        let b = unpack_octet(shading[at.y]);
        let c = unpack_octet(shading[at.z]);
        let d = unpack_octet(shading[at.w]);
        let e = unpack_octet(residual[at.x]);
        let f = unpack_octet(residual[at.y]);
        let g = unpack_octet(residual[at.z]);
        let h = unpack_octet(residual[at.w]);
        let first = octet * 8u;
        visit(&gram, &frames, k, texel, first + 0u, vec4(a.low.x, b.low.x, c.low.x, d.low.x), vec4(e.low.x, f.low.x, g.low.x, h.low.x));
        visit(&gram, &frames, k, texel, first + 1u, vec4(a.low.y, b.low.y, c.low.y, d.low.y), vec4(e.low.y, f.low.y, g.low.y, h.low.y));
        visit(&gram, &frames, k, texel, first + 2u, vec4(a.low.z, b.low.z, c.low.z, d.low.z), vec4(e.low.z, f.low.z, g.low.z, h.low.z));
        visit(&gram, &frames, k, texel, first + 3u, vec4(a.low.w, b.low.w, c.low.w, d.low.w), vec4(e.low.w, f.low.w, g.low.w, h.low.w));
        visit(&gram, &frames, k, texel, first + 4u, vec4(a.high.x, b.high.x, c.high.x, d.high.x), vec4(e.high.x, f.high.x, g.high.x, h.high.x));
        visit(&gram, &frames, k, texel, first + 5u, vec4(a.high.y, b.high.y, c.high.y, d.high.y), vec4(e.high.y, f.high.y, g.high.y, h.high.y));
        visit(&gram, &frames, k, texel, first + 6u, vec4(a.high.z, b.high.z, c.high.z, d.high.z), vec4(e.high.z, f.high.z, g.high.z, h.high.z));
        visit(&gram, &frames, k, texel, first + 7u, vec4(a.high.w, b.high.w, c.high.w, d.high.w), vec4(e.high.w, f.high.w, g.high.w, h.high.w));
    }
    grams[group.z * params.quads + quad] = gram;
}
