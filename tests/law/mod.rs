//! What must hold without a twin.

crate::suites! {
    fft,
    frankot_chellappa,
    lafortune_fit,
    normals,
    percentile,
    photometric_stereo,
    specular_scale,
}
