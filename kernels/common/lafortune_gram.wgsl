// Gram matrix of (m, g, r) over samples, g = (w p, l), of four fits side by side: one component each. m = (k . p)^n,
// w = m/(k . p), l = m ln(k . p), r = A m - s; and of the constant column c of fits in frames with (m, g, r).
struct Gram {
    // m^2, m r, r^2
    mm: vec4<f32>,
    mr: vec4<f32>,
    rr: vec4<f32>,
    // m g
    mx: vec4<f32>,
    my: vec4<f32>,
    mz: vec4<f32>,
    ml: vec4<f32>,
    // r g
    rx: vec4<f32>,
    ry: vec4<f32>,
    rz: vec4<f32>,
    rl: vec4<f32>,
    // g g^T
    xx: vec4<f32>,
    yy: vec4<f32>,
    zz: vec4<f32>,
    ll: vec4<f32>,
    xy: vec4<f32>,
    xz: vec4<f32>,
    yz: vec4<f32>,
    xl: vec4<f32>,
    yl: vec4<f32>,
    zl: vec4<f32>,
    // c^2, c m, c g, c r; 0 without a constant column
    cc: vec4<f32>,
    cm: vec4<f32>,
    cx: vec4<f32>,
    cy: vec4<f32>,
    cz: vec4<f32>,
    cl: vec4<f32>,
    cr: vec4<f32>,
}

// Fits side by side.
const FITS: u32 = 4u;
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
    // of the constant column
    constant: vec4<f32>,
}

fn add_columns(gram: ptr<function, Gram>, m: vec4<f32>, x: vec4<f32>, y: vec4<f32>, z: vec4<f32>, l: vec4<f32>, r: vec4<f32>) {
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
fn visited(index: u32, stride: u32, octets: u32) -> u32 {
    return min(index * stride + ((index * 2654435769u) >> 16u) % stride, octets - 1u);
}
