//! What must hold without a twin.

crate::suites! {
    brdf_values,
    color,
    fft,
    frankot_chellappa,
    gather,
    kubelka_munk,
    lafortune_fit,
    microfacet,
    normals,
    paint_relief,
    path_traced,
    pattern,
    percentile,
    photometric_stereo,
    pigments,
    plane,
    reconstruct,
    specular_residual,
    specular_scale,
    tiles,
}
