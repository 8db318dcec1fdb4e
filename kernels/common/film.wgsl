// Kubelka-Munk film in f32, three channels at once (model::kubelka_munk).
// Written in s = S d and k = K d, never in K/S: s = 0, k = 0, d = 0 and opaque films need no case of their own, and nothing
// overflows while s and k stay below 1e30.

struct Film {
    // R over black
    reflectance: vec3<f32>,
    // 1 - R, from its own sum of positive terms: for a white opaque film R rounds to 1
    complement: vec3<f32>,
    // T
    transmittance: vec3<f32>,
}

// Below this q the quotient of exponentials cancels and the series of tanh(q)/q takes over, there good to 3e-7.
const SMALL_Q: f32 = 0.3;

// tanh(q)/q for q >= 0, with x = exp(-q).
fn tanh_over(q: vec3<f32>, x: vec3<f32>) -> vec3<f32> {
    let q2 = min(q, vec3(SMALL_Q)) * min(q, vec3(SMALL_Q));
    let series = 1.0 - q2 * (1.0 / 3.0 - q2 * (2.0 / 15.0 - q2 * (17.0 / 315.0 - q2 * (62.0 / 2835.0))));
    let quotient = (1.0 - x * x) / ((1.0 + x * x) * max(q, vec3(SMALL_Q)));
    return select(quotient, series, q < vec3(SMALL_Q));
}

// R, 1 - R and T (3.7), numerators and denominators divided by b cosh(q), q = bSd.
fn film(scattering: vec3<f32>, absorption: vec3<f32>) -> Film {
    // Two roots, since the product under one would overflow first.
    let q = sqrt(absorption) * sqrt(absorption + 2.0 * scattering);
    let x = exp(-q);
    let t = tanh_over(q, x);
    let denominator = 1.0 + (scattering + absorption) * t;
    return Film(scattering * t / denominator, (1.0 + absorption * t) / denominator, 2.0 * x / ((1.0 + x * x) * denominator));
}

// 1 - R rho between a film and the reflectance `below` it, as (1 - R) + R(1 - rho): a sum of positive terms up to rho = 1 itself.
fn lost_between(coat: Film, below: vec3<f32>) -> vec3<f32> {
    return coat.complement + coat.reflectance * (1.0 - min(below, vec3(1.0)));
}

// Reflectance of a film on a substrate of at most 1: R + T^2 rho/(1 - R rho) (3.9).
fn over_substrate(coat: Film, substrate: vec3<f32>) -> vec3<f32> {
    // T/(1 - R rho) is at most 1; T^2 alone could underflow.
    return coat.reflectance + coat.transmittance * through(coat, substrate) * substrate;
}

// Factor by which a film changes the transmittance of a stack that reflects `below` from above: T/(1 - R rho) (3.8).
fn through(coat: Film, below: vec3<f32>) -> vec3<f32> {
    return coat.transmittance / lost_between(coat, below);
}
