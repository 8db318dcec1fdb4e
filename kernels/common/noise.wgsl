// Value noise on an integer lattice. The lattice is hashed in integers, so every adapter sees the same pattern.

// A bijection of 32 bits whose output looks random (lowbias32; model::pattern::hash).
fn hash(value: u32) -> u32 {
    var x = value;
    x = (x ^ (x >> 16u)) * 0x7feb352du;
    x = (x ^ (x >> 15u)) * 0x846ca68bu;
    return x ^ (x >> 16u);
}

// Random bits of a lattice point; the lattice repeats after `period` points.
fn lattice_bits(point: vec2<i32>, period: vec2<u32>, seed: u32) -> u32 {
    let n = vec2<i32>(period);
    let wrapped = vec2<u32>(((point % n) + n) % n);
    return hash(wrapped.x ^ hash(wrapped.y ^ hash(seed)));
}

// Uniform in [0, 1): the upper 24 of 32 random bits.
fn unit(bits: u32) -> f32 {
    return f32(bits >> 8u) * (1.0 / 16777216.0);
}

fn lattice(point: vec2<i32>, period: vec2<u32>, seed: u32) -> f32 {
    return unit(lattice_bits(point, period, seed));
}

// Smooth noise in [0, 1): lattice values a unit apart, joined by 3t^2 - 2t^3 (Perlin 1985).
fn noise(place: vec2<f32>, period: vec2<u32>, seed: u32) -> f32 {
    let corner = floor(place);
    let t = place - corner;
    let weight = t * t * (3.0 - 2.0 * t);
    let point = vec2<i32>(corner);
    let below = mix(lattice(point, period, seed), lattice(point + vec2(1, 0), period, seed), weight.x);
    let above = mix(lattice(point + vec2(0, 1), period, seed), lattice(point + vec2(1, 1), period, seed), weight.x);
    return mix(below, above, weight.y);
}
