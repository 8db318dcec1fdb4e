// Whether a sample is no radiance and takes no part in anything: any of its channels, as bits of halves, is NaN, infinite or negative.
// On the bits, since a shader may take it that no float is NaN. Twin: reference::gather.
fn is_masked(bits: vec3<u32>) -> bool {
    // Infinity is 0x7c00; NaN and all with the sign bit lie above, of which -0 alone is a radiance.
    return any((bits >= vec3(0x7c00u)) & (bits != vec3(0x8000u)));
}
