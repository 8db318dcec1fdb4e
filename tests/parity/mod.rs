//! Each kernel against its twin.

crate::suites! {
    brdf_values,
    fft,
    frankot_chellappa,
    gather,
    kubelka_munk,
    lafortune_fit,
    microfacet,
    normals,
    paint_relief,
    pattern,
    percentile,
    photometric_stereo,
    picture_error,
    plane,
    reconstruct,
    specular_residual,
    specular_scale,
    synth,
}
