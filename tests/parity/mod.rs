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
    plane,
    reconstruct,
    seen_surface,
    specular_residual,
    specular_scale,
    synth,
}
