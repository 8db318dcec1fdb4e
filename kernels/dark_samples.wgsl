// Masks the samples that are too dark to be lit: on a rough surface they lie in shadow, and the quantile that rho_d is taken for
// would find them (thesis section 3.2.2, rough surfaces). Too dark is a mean over the channels below a fraction of the mean of
// the texel's medians. All else keeps its bits. One thread an octet of one texel. Twin: reference::dark_samples.
#import thread
#import octet

struct Params {
    texels: u32,
    octets: u32,
    samples: u32,
    dark_fraction: f32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [channel][octet][texel], pi times the reflectance, negative where masked
@group(0) @binding(1) var<storage, read> reflectance: array<vec4<u32>>;
// [texel], median of each channel's valid samples
@group(0) @binding(2) var<storage, read> median: array<vec4<f32>>;
// [channel][octet][texel], the same with dark samples -1
@group(0) @binding(3) var<storage, read_write> lit: array<vec4<u32>>;

const SIZE: u32 = 64u;
// The bits of -1.
const MASKED: u32 = 0xbc00u;

// The halves of a word, those masked that are dark.
fn mask_dark(word: u32, dark: vec2<bool>) -> u32 {
    return select(word & 0xffffu, MASKED, dark.x) | (select(word >> 16u, MASKED, dark.y) << 16u);
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let index = thread_index(group, groups, local, SIZE);
    let plane = params.octets * params.texels;
    if index >= plane {
        return;
    }
    let red = unpack_octet(reflectance[index]);
    let green = unpack_octet(reflectance[plane + index]);
    let blue = unpack_octet(reflectance[2u * plane + index]);
    // Sums for means: three channels on both sides.
    let middle = median[index % params.texels];
    let bound = vec4(params.dark_fraction * (middle.r + middle.g + middle.b));
    // What is masked already is below the bound, and stays as it is.
    let valid_low = min(min(red.low, green.low), blue.low) >= vec4(0.0);
    let valid_high = min(min(red.high, green.high), blue.high) >= vec4(0.0);
    let first = (index / params.texels) * 8u;
    let sample = vec4(first) + vec4(0u, 1u, 2u, 3u);
    let dark_low = valid_low & (red.low + green.low + blue.low < bound) & (sample < vec4(params.samples));
    let dark_high = valid_high & (red.high + green.high + blue.high < bound) & (sample + 4u < vec4(params.samples));
    for (var channel = 0u; channel < 3u; channel++) {
        let words = reflectance[channel * plane + index];
        lit[channel * plane + index] = vec4(
            mask_dark(words.x, dark_low.xy),
            mask_dark(words.y, dark_low.zw),
            mask_dark(words.z, dark_high.xy),
            mask_dark(words.w, dark_high.zw),
        );
    }
}
