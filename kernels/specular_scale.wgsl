// rho_s of each channel once the lobe is known: the least-squares ratio sum s l / sum l^2, or the thesis' mean of s/l over
// samples whose lobe is above a bound (eq. 3.6), with s = max(f - rho_d, 0), over the samples that are not masked.
// One thread a texel.
// Twin: reference::specular_scale.
#import thread
#import octet
#import lafortune

struct Params {
    texels: u32,
    octets: u32,
    // 0 least squares, 1 mean of ratios
    rule: u32,
    min_lobe: f32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [sample, filled up to octets], w_i * w_o by components; zero past the last sample
@group(0) @binding(1) var<storage, read> products: array<vec4<f32>>;
// [channel][octet][texel], pi times the reflectance, negative where masked
@group(0) @binding(2) var<storage, read> reflectance: array<vec4<u32>>;
// [texel], rho_d of each channel
@group(0) @binding(3) var<storage, read> diffuse: array<vec4<f32>>;
// [texel], (C_x, C_y, C_z, n)
@group(0) @binding(4) var<storage, read> lobes: array<vec4<f32>>;
// [texel], rho_s of each channel, w = 0
@group(0) @binding(5) var<storage, read_write> specular: array<vec4<f32>>;

const SIZE: u32 = 64u;
const MEAN_RATIO: u32 = 1u;

struct Sums {
    above: vec3<f32>,
    below: f32,
}

fn add_sample(sums: ptr<function, Sums>, lobe: vec4<f32>, product: vec3<f32>, f: vec3<f32>, rho: vec3<f32>) {
    // No lobe, no part in either sum.
    let l = select(lafortune(lobe, product), 0.0, any(f < vec3(0.0)));
    let s = max(f - rho, vec3(0.0));
    if params.rule == MEAN_RATIO {
        if l > params.min_lobe {
            (*sums).above += s / l;
            (*sums).below += 1.0;
        }
    } else {
        (*sums).above += s * l;
        (*sums).below += l * l;
    }
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    if texel >= params.texels {
        return;
    }
    let lobe = lobes[texel];
    let rho = diffuse[texel].rgb;
    let plane = params.octets * params.texels;
    var total = Sums();
    for (var octet = 0u; octet < params.octets; octet++) {
        let red = unpack_octet(reflectance[octet * params.texels + texel]);
        let green = unpack_octet(reflectance[plane + octet * params.texels + texel]);
        let blue = unpack_octet(reflectance[2u * plane + octet * params.texels + texel]);
        let first = octet * 8u;
        // The eight samples of an octet are summed apart: shorter sums round less.
        var part = Sums();
        for (var i = 0u; i < 4u; i++) {
            let low = vec3(red.low[i], green.low[i], blue.low[i]);
            let high = vec3(red.high[i], green.high[i], blue.high[i]);
            add_sample(&part, lobe, products[first + i].xyz, low, rho);
            add_sample(&part, lobe, products[first + 4u + i].xyz, high, rho);
        }
        total.above += part.above;
        total.below += part.below;
    }
    // Too little lobe to divide by: of squares, or of counted samples.
    let least = select(params.min_lobe * params.min_lobe, 0.5, params.rule == MEAN_RATIO);
    if total.below > least {
        specular[texel] = vec4(total.above / total.below, 0.0);
    } else {
        specular[texel] = vec4(0.0);
    }
}
