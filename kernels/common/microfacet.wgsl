// Reflection at a paint's surface (model::microfacet): Schlick's Fresnel term on a GGX lobe.

// F0 + (1 - F0)(1 - cosine)^5 (Schlick 1994 eq. 15); cosine between light and microfacet.
fn schlick(f0: f32, cosine: f32) -> f32 {
    let rest = saturate(1.0 - cosine);
    let rest2 = rest * rest;
    return f0 + (1.0 - f0) * rest2 * rest2 * rest;
}

// pi f_r cos(theta_i): the radiance towards `view` under irradiance pi on a plane facing `light`; 0 below the horizon.
// GGX (Walter et al. 2007 eq. 33) with Smith's height-correlated masking (Heitz 2014 eq. 99). Unit vectors that point away.
fn ggx_specular(normal: vec3<f32>, view: vec3<f32>, light: vec3<f32>, roughness: f32, f0: f32) -> f32 {
    let cosine_view = dot(normal, view);
    let cosine_light = dot(normal, light);
    if cosine_view <= 0.0 || cosine_light <= 0.0 {
        return 0.0;
    }
    let half_way = normalize(view + light);
    let alpha2 = roughness * roughness;
    // cos^2(alpha^2 - 1) + 1 = alpha^2 cos^2 + sin^2; the sine from the cross product, since 1 - cos^2 cancels in a narrow lobe.
    let cosine_half = dot(normal, half_way);
    let across = cross(normal, half_way);
    let spread = alpha2 * cosine_half * cosine_half + dot(across, across);
    let masked_view = cosine_light * sqrt(alpha2 + (1.0 - alpha2) * cosine_view * cosine_view);
    let masked_light = cosine_view * sqrt(alpha2 + (1.0 - alpha2) * cosine_light * cosine_light);
    return 0.5 * cosine_light * schlick(f0, dot(light, half_way)) * (alpha2 / (spread * spread)) / (masked_view + masked_light);
}
