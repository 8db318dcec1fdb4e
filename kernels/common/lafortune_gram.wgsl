// Gram matrix of (m, g, r) over samples, g = (w p, l), of four fits side by side: one component each. m = (k . p)^n,
// w = m/(k . p), l = m ln(k . p), r = A m - s.
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
}

// Fits side by side.
const FITS: u32 = 4u;
