//! Each kernel against its twin.

crate::suites! {
    brdf_values,
    dark_samples,
    fft,
    frankot_chellappa,
    gather,
    kubelka_munk,
    lafortune_fit,
    linear_refit,
    microfacet,
    normals,
    paint_relief,
    pattern,
    percentile,
    photometric_stereo,
    plane,
    radiance_error,
    reconstruct,
    specular_residual,
    specular_scale,
    synth,
}
