//! Each kernel against its twin.

crate::suites! {
    brdf_values,
    fft,
    flatness,
    frankot_chellappa,
    gather,
    kubelka_munk,
    lafortune_fit,
    lobe_residual,
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
