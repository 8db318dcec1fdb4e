//! Each kernel against its twin.

crate::suites! {
    brdf_values,
    fft,
    frankot_chellappa,
    lafortune_fit,
    normals,
    percentile,
    photometric_stereo,
    specular_residual,
    specular_scale,
    srgb_decode,
}
