// Normal and albedo of each texel from its radiance under known lights, the view fixed near the zenith: g minimises
// Σ_l w_l (I_l − l·g)², with l the direction to a light and I_l the mean of the three channels; n = g/|g|, albedo = |g|.
// Masked samples have no weight. Each step adds to g the solution δ of (Σ w l lᵀ) δ = Σ w r l, r = I − l·g, so rounding in the
// matrix delays a step but does not enter the result. One thread a texel.
//
// Least squares, w = 1: Rushmeier, Taubin and Guéziec 1997; thesis eq. 3.1, 3.2. Its second step takes out the rounding of the first.
// Robust: the likeliest g if residuals of lit samples follow Cauchy's distribution, whose scale is estimated along with g, by
// reweighting: w = s/(1 + r²/v), v = Σ w r²/Σ w about the last solution (Lange, Little and Taylor 1989, one degree of freedom;
// the divisor Σ w is that of Kent, Tyler and Vardi 1994). s falls from 1 to 0 where the light sinks to the horizon of g,
// since radiance is max(0, l·g). The first step has w = √I: shadows pull less than highlights would with w = I.
// Twin: reference::photometric_stereo.
#import thread
#import octet

struct Params {
    texels: u32,
    octets: u32,
    // passes over the samples
    steps: u32,
    // 1: robust, 0: least squares
    robust: u32,
    // least pivot of the matrix, over its trace
    min_pivot: f32,
    // cosine of incidence below which s falls
    terminator: f32,
    // least √v over |g|
    noise: f32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [channel][octet][texel], octets of radiance in reflectance units; a sample is masked where its first channel is negative
@group(0) @binding(1) var<storage, read> samples: array<vec4<u32>>;
// [sample], direction to the light in xyz (x right, y up, z out); zeros where an octet is padded
@group(0) @binding(2) var<storage, read> lights: array<vec4<f32>>;
// [texel], unit normal (x right, y up, z out), w = albedo; (0, 0, 1) and 0 where g = 0 or the samples do not determine it
@group(0) @binding(3) var<storage, read_write> normals: array<vec4<f32>>;

const SIZE: u32 = 64u;
const MASKED: f32 = -1.0;

// What is known of a texel after a step.
struct Estimate {
    g: vec3<f32>,
    albedo: f32,
    variance: f32,
}

// The weighted sums of a step.
struct Sums {
    // Σ w l_x², Σ w l_y², Σ w l_z²
    squares: vec3<f32>,
    // Σ w l_x l_y, Σ w l_x l_z, Σ w l_y l_z
    products: vec3<f32>,
    // Σ w r l
    moment: vec3<f32>,
    // Σ w r²
    residual: f32,
    // Σ w
    weight: f32,
}

struct Solution {
    step: vec3<f32>,
    determined: bool,
}

// Means of the channels; MASKED whatever the other channels hold.
fn radiance_octet(at: u32) -> Octet {
    let channel_stride = params.octets * params.texels;
    let red = unpack_octet(samples[at]);
    let green = unpack_octet(samples[at + channel_stride]);
    let blue = unpack_octet(samples[at + 2u * channel_stride]);
    return Octet(
        select((red.low + green.low + blue.low) / 3.0, vec4(MASKED), red.low < vec4(0.0)),
        select((red.high + green.high + blue.high) / 3.0, vec4(MASKED), red.high < vec4(0.0)),
    );
}

fn weight(radiance: f32, predicted: f32, estimate: Estimate, first: bool) -> f32 {
    if radiance < 0.0 {
        return 0.0;
    }
    if params.robust == 0u {
        return 1.0;
    }
    if first {
        return sqrt(radiance);
    }
    let lit = saturate(predicted / (params.terminator * estimate.albedo));
    let residual = radiance - predicted;
    return lit / (1.0 + residual * residual / estimate.variance);
}

fn add(sums: ptr<function, Sums>, radiance: f32, light: vec3<f32>, estimate: Estimate, first: bool) {
    let predicted = dot(light, estimate.g);
    let residual = radiance - predicted;
    let w = weight(radiance, predicted, estimate, first);
    (*sums).squares += w * light * light;
    (*sums).products += w * light.xxy * light.yzz;
    (*sums).moment += w * residual * light;
    (*sums).residual += w * residual * residual;
    (*sums).weight += w;
}

// By A = L·D·Lᵀ. A pivot is what is left of a coordinate's square once the coordinates before it are taken out: without it
// the lights lie in a plane, or there are fewer than three.
fn solve(sums: Sums) -> Solution {
    let undetermined = Solution(vec3(0.0), false);
    let least = params.min_pivot * (sums.squares.x + sums.squares.y + sums.squares.z);
    let d_x = sums.squares.x;
    if !(d_x > least) {
        return undetermined;
    }
    let y_of_x = sums.products.x / d_x;
    let z_of_x = sums.products.y / d_x;
    let d_y = sums.squares.y - y_of_x * sums.products.x;
    if !(d_y > least) {
        return undetermined;
    }
    let rest = sums.products.z - y_of_x * sums.products.y;
    let z_of_y = rest / d_y;
    let d_z = sums.squares.z - z_of_x * sums.products.y - z_of_y * rest;
    if !(d_z > least) {
        return undetermined;
    }
    let b_y = sums.moment.y - y_of_x * sums.moment.x;
    let b_z = sums.moment.z - z_of_x * sums.moment.x - z_of_y * b_y;
    let z = b_z / d_z;
    let y = b_y / d_y - z_of_y * z;
    let x = sums.moment.x / d_x - y_of_x * y - z_of_x * z;
    return Solution(vec3(x, y, z), true);
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    if texel >= params.texels {
        return;
    }
    var estimate = Estimate(vec3(0.0), 0.0, 0.0);
    for (var step = 0u; step < params.steps; step++) {
        var sums = Sums(vec3(0.0), vec3(0.0), vec3(0.0), 0.0, 0.0);
        for (var octet = 0u; octet < params.octets; octet++) {
            let values = radiance_octet(octet * params.texels + texel);
            for (var i = 0u; i < 4u; i++) {
                add(&sums, values.low[i], lights[8u * octet + i].xyz, estimate, step == 0u);
                add(&sums, values.high[i], lights[8u * octet + 4u + i].xyz, estimate, step == 0u);
            }
        }
        let solution = solve(sums);
        if !solution.determined {
            break;
        }
        estimate.g += solution.step;
        estimate.albedo = length(estimate.g);
        if !(estimate.albedo > 0.0) {
            break;
        }
        // Σ w r² after the step, by the normal equations.
        let residual = sums.residual - dot(solution.step, sums.moment);
        let least = params.noise * estimate.albedo;
        estimate.variance = max(residual / sums.weight, least * least);
    }
    if estimate.albedo > 0.0 {
        normals[texel] = vec4(estimate.g / estimate.albedo, estimate.albedo);
    } else {
        normals[texel] = vec4(0.0, 0.0, 1.0, 0.0);
    }
}
