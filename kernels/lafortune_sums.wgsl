// The sums that a step of the Lafortune fit goes by: the Gram matrix of model, gradient and residual at each running fit's
// candidate, over one slice of the samples. One thread four fits and a slice (z): each direction is loaded once for four
// fits, and slices keep all of an adapter busy when fits are few and a sum's rounding near that of one slice.
// Of every `stride` octets one is visited, so that early steps see a part of the samples; which one is by Fibonacci hashing
// (Knuth 6.4), since a regular stride could meet the same lights under each view.
// A masked sample (s < 0) is taken as one with s = 0 that no lobe reaches, so that each of its terms is 0.
// Twin: reference::lafortune_fit, of the whole stage.
#import thread
#import octet
#import lafortune_state
#import lafortune_gram

struct Params {
    texels: u32,
    octets: u32,
    // a power of two
    stride: u32,
    // quads of fits in a slice's array
    quads: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [sample, filled up to octets], w_i * w_o by components, w = 0; zero past the last sample
@group(0) @binding(1) var<storage, read> products: array<vec4<f32>>;
// [octet][texel], mean specular residual as halves, negative where masked
@group(0) @binding(2) var<storage, read> residual: array<vec4<u32>>;
// [start][texel]
@group(0) @binding(3) var<storage, read> states: array<FitState>;
// number of fits that still run, then those fits
@group(0) @binding(4) var<storage, read> listed: array<u32>;
// [slice][quad of listed fits]
@group(0) @binding(5) var<storage, read_write> grams: array<Gram>;

const SIZE: u32 = 64u;
// Visited octets of a slice.
const SLICE: u32 = 64u;
const LN_2: f32 = 0.6931471805599453;

// The candidates of four fits.
struct Candidates {
    x: vec4<f32>,
    y: vec4<f32>,
    z: vec4<f32>,
    exponent: vec4<f32>,
    amplitude: vec4<f32>,
}

fn add_sample(gram: ptr<function, Gram>, k: Candidates, product: vec3<f32>, s: vec4<f32>) {
    let base = k.x * product.x + k.y * product.y + k.z * product.z;
    let log_base = log2(max(base, vec4(1e-30)));
    let w = select(vec4(0.0), exp2((k.exponent - 1.0) * log_base), (base > vec4(0.0)) & (s >= vec4(0.0)));
    let m = w * base;
    let r = k.amplitude * m - max(s, vec4(0.0));
    let x = w * product.x;
    let y = w * product.y;
    let z = w * product.z;
    let l = m * log_base * LN_2;
    (*gram).mm += m * m;
    (*gram).mr += m * r;
    (*gram).rr += r * r;
    (*gram).mx += m * x;
    (*gram).my += m * y;
    (*gram).mz += m * z;
    (*gram).ml += m * l;
    (*gram).rx += r * x;
    (*gram).ry += r * y;
    (*gram).rz += r * z;
    (*gram).rl += r * l;
    (*gram).xx += x * x;
    (*gram).yy += y * y;
    (*gram).zz += z * z;
    (*gram).ll += l * l;
    (*gram).xy += x * y;
    (*gram).xz += x * z;
    (*gram).yz += y * z;
    (*gram).xl += x * l;
    (*gram).yl += y * l;
    (*gram).zl += z * l;
}

// The octet that is visited for the `index`th time.
fn visited(index: u32) -> u32 {
    return min(index * params.stride + ((index * 2654435769u) >> 16u) % params.stride, params.octets - 1u);
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
    }
    var gram = Gram();
    let end = min((group.z + 1u) * SLICE, (params.octets + params.stride - 1u) / params.stride);
    for (var index = group.z * SLICE; index < end; index++) {
        let octet = visited(index);
        let row = octet * params.texels;
        let a = unpack_octet(residual[row + texel.x]);
        let b = unpack_octet(residual[row + texel.y]);
        let c = unpack_octet(residual[row + texel.z]);
        let d = unpack_octet(residual[row + texel.w]);
        let first = octet * 8u;
        add_sample(&gram, k, products[first].xyz, vec4(a.low.x, b.low.x, c.low.x, d.low.x));
        add_sample(&gram, k, products[first + 1u].xyz, vec4(a.low.y, b.low.y, c.low.y, d.low.y));
        add_sample(&gram, k, products[first + 2u].xyz, vec4(a.low.z, b.low.z, c.low.z, d.low.z));
        add_sample(&gram, k, products[first + 3u].xyz, vec4(a.low.w, b.low.w, c.low.w, d.low.w));
        add_sample(&gram, k, products[first + 4u].xyz, vec4(a.high.x, b.high.x, c.high.x, d.high.x));
        add_sample(&gram, k, products[first + 5u].xyz, vec4(a.high.y, b.high.y, c.high.y, d.high.y));
        add_sample(&gram, k, products[first + 6u].xyz, vec4(a.high.z, b.high.z, c.high.z, d.high.z));
        add_sample(&gram, k, products[first + 7u].xyz, vec4(a.high.w, b.high.w, c.high.w, d.high.w));
    }
    grams[group.z * params.quads + quad] = gram;
}
