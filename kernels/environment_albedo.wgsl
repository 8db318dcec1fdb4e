// Directional albedo of the surface of `microfacet`, F0 scale + bias, for all roughnesses and views: with Schlick's F = F0 + (1 - F0) c,
// c = (1 - v.h)^5, scale is the integral of D G2/(4 n.v n.l) (1 - c) n.l over all lights and bias that with c instead (Karis 2013).
// Facets are taken in proportion to how well the view sees them (Heitz 2018), as directions on a spherical cap (Dupuy, Benyoub 2023);
// what is left to sum is G2/G1, from 0 to 1. One thread an entry. Twin: reference::environment.
#import thread

struct Params {
    // roughnesses and cosines
    size: u32,
    _pad0: u32,
    _pad1: u32,
    _pad2: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [roughness][cosine], squares of even steps from 0 to 1: (scale, bias)
@group(0) @binding(1) var<storage, read_write> albedo: array<vec2<f32>>;

const SIZE: u32 = 64u;
const PI: f32 = 3.14159265358979;
// Steps of the quadrature, along the cap's height and around half of it: the other half is its mirror image.
const RINGS: u32 = 64u;
const SPOKES: u32 = 32u;
// A mirror.
const SMOOTHEST: f32 = 1e-6;

// sqrt(cos^2 + alpha^2 sin^2).
fn masked_cosine(alpha: f32, cosine: f32) -> f32 {
    return sqrt(alpha * alpha + (1.0 - alpha * alpha) * cosine * cosine);
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let index = thread_index(group, groups, local, SIZE);
    if index >= params.size * params.size {
        return;
    }
    let step = vec2(f32(index % params.size), f32(index / params.size)) / f32(params.size - 1u);
    let cosine = step.x * step.x;
    let alpha = max(step.y * step.y, SMOOTHEST);
    let sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    let masked_view = masked_cosine(alpha, cosine);
    // The view where the facets are a hemisphere.
    let stretched = vec2(alpha * sine, cosine) / length(vec2(alpha * sine, cosine));
    let height = 1.0 + stretched.y;
    var scale = 0.0;
    var bias = 0.0;
    for (var ring = 0u; ring < RINGS; ring++) {
        // Close steps where the steepest facets are.
        let t = (f32(ring) + 0.5) / f32(RINGS);
        let above = t * t;
        // z = above height - stretched.y is even over the cap; 1 - z^2 without cancellation.
        let radius = sqrt(max(height * (1.0 - above) * (1.0 - stretched.y + above * height), 0.0));
        var ring_sum = vec2(0.0);
        for (var spoke = 0u; spoke < SPOKES; spoke++) {
            let angle = PI * (f32(spoke) + 0.5) / f32(SPOKES);
            let facet = normalize(vec3(alpha * (radius * cos(angle) + stretched.x), alpha * radius * sin(angle), above * height));
            let cosine_facet = sine * facet.x + cosine * facet.z;
            let cosine_light = 2.0 * cosine_facet * facet.z - cosine;
            if cosine_light > 0.0 {
                let masked_light = masked_cosine(alpha, cosine_light);
                // G2/G1 of Smith's height-correlated masking.
                let seen = cosine_light * (masked_view + cosine) / (masked_view * cosine_light + masked_light * cosine);
                let rest = saturate(1.0 - cosine_facet);
                let rest2 = rest * rest;
                let c = rest2 * rest2 * rest;
                ring_sum += seen * vec2(1.0 - c, c);
            }
        }
        scale += 2.0 * t * ring_sum.x;
        bias += 2.0 * t * ring_sum.y;
    }
    albedo[index] = vec2(scale, bias) / f32(RINGS * SPOKES);
}
