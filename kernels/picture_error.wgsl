// Errors of a picture against its original, e = R - L per channel: summed over the texels of each workgroup, and added to what each texel
// has from other pictures. A texel whose original is no radiance takes no part. One thread a texel. sRGB: IEC 61966-2-1:1999, 5.2.
// picture_error_sum joins the workgroups. Twin: reference::picture_error.
#import thread
#import masked
#import picture_sums

struct Params {
    texels: u32,
    // workgroups of a picture
    groups: u32,
    // which of the originals
    pair: u32,
    _pad: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [row][column], linear RGB in reflectance units, w unused
@group(0) @binding(1) var<storage, read> picture: array<vec4<f32>>;
// [pair][channel][texel], linear radiance in reflectance units as halves, two a word, the first of them in its low bits
@group(0) @binding(2) var<storage, read> originals: array<u32>;
// [texel], squared error and squared original summed over pairs, reflectance units squared, red, green and blue together
@group(0) @binding(3) var<storage, read_write> texel_sums: array<vec2<f32>>;
// [pair][workgroup]
@group(0) @binding(4) var<storage, read_write> partials: array<PictureSums>;

fn half_at(channel: u32, texel: u32) -> u32 {
    let index = (3u * params.pair + channel) * params.texels + texel;
    return (originals[index / 2u] >> (16u * (index & 1u))) & 0xffffu;
}

fn srgb(linear: vec3<f32>) -> vec3<f32> {
    let held = clamp(linear, vec3(0.0), vec3(1.0));
    return select(1.055 * pow(held, vec3(1.0 / 2.4)) - 0.055, 12.92 * held, held <= vec3(0.0031308));
}

fn errors_of(texel: u32) -> PictureSums {
    let bits = vec3(half_at(0u, texel), half_at(1u, texel), half_at(2u, texel));
    if is_masked(bits) {
        return PictureSums();
    }
    let original = vec3(unpack2x16float(bits.x).x, unpack2x16float(bits.y).x, unpack2x16float(bits.z).x);
    let found = picture[texel].rgb;
    let error = found - original;
    let shown = srgb(found) - srgb(original);
    return PictureSums(
        dot(error, error),
        error.r + error.g + error.b,
        dot(original, original),
        original.r + original.g + original.b,
        dot(shown, shown),
        1.0,
    );
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    var sums = PictureSums();
    if texel < params.texels {
        sums = errors_of(texel);
        texel_sums[texel] += vec2(sums.squared_error, sums.squared_original);
    }
    let folded = fold(local, sums);
    let index = texel / SIZE;
    if local == 0u && index < params.groups {
        partials[params.pair * params.groups + index] = folded;
    }
}
