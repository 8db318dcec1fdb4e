// Reflection of a rough dielectric coat: GGX facets with Smith's separable masking (Walter, Marschner, Li, Torrance 2007
// eq. 20, 33, 34) and Schlick's Fresnel term (Schlick 1994).

// F = f0 + (1 - f0)(1 - cosine)^5, cosine between direction and facet.
fn schlick(f0: f32, cosine: f32) -> f32 {
    let m = 1.0 - clamp(cosine, 0.0, 1.0);
    let m2 = m * m;
    return f0 + (1.0 - f0) * m2 * m2 * m;
}

// pi f_r cos(theta_i), f_r = F D G / (4 n.l n.v), of unit vectors; `roughness` is Walter's alpha, above zero. With
// A(c) = c + sqrt(alpha^2 + (1 - alpha^2) c^2) Smith's G1(c) is 2c/A(c), and the division by n.v cancels.
fn ggx_specular(normal: vec3<f32>, view: vec3<f32>, light: vec3<f32>, roughness: f32, f0: f32) -> f32 {
    let cos_view = dot(normal, view);
    let cos_light = dot(normal, light);
    if cos_view <= 0.0 || cos_light <= 0.0 {
        return 0.0;
    }
    let facet = normalize(view + light);
    let alpha2 = roughness * roughness;
    // alpha^2 cos^2 + sin^2 of the facet's angle, the sine from the cross product: 1 - cos^2 would cancel at the peak.
    let off = cross(normal, facet);
    let cos_facet = dot(normal, facet);
    let spread = alpha2 * cos_facet * cos_facet + dot(off, off);
    let masking_view = cos_view + sqrt(alpha2 + (1.0 - alpha2) * cos_view * cos_view);
    let masking_light = cos_light + sqrt(alpha2 + (1.0 - alpha2) * cos_light * cos_light);
    return schlick(f0, dot(facet, light)) * alpha2 / (spread * spread) * cos_light / (masking_view * masking_light);
}
