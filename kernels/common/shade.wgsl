// Radiance that leaves a place of the base plane towards the view, in reflectance units: pi L_o / E, E the irradiance on a
// surface that faces the light. Method sections 3, 4 and 6. Twin: reference::shade.
#import lafortune
#import microfacet
#import relief

// The measured reflectance, fitted in the base plane's frame: its cosine is that plane's too.
fn unpainted_radiance(texel: u32) -> vec3<f32> {
    let lobe = lafortune(lobes[texel], scene.view.xyz * scene.light.xyz);
    return (diffuse[texel].rgb + specular[texel].rgb * lobe) * scene.light.z;
}

// Kubelka-Munk diffuse below a coat: of the light 1 - F enters and leaves at the angles of light and view, divided by the mean
// of 1 - F over the hemisphere, so that what is not reflected is what the diffuse part gets (Kelemen, Szirmay-Kalos 2001).
// Schlick's F has the cosine-weighted mean f0 + (1 - f0)/21. A normal that turns from the view further than the base plane does
// is taken at the plane's angle: normals on a rim average in the side that is hidden, and would draw it dark.
fn painted_radiance(texel: u32) -> vec3<f32> {
    let view = scene.view.xyz;
    let light = scene.light.xyz;
    let normal = normals[texel].xyz;
    let cos_light = max(dot(normal, light), 0.0);
    let through = (1.0 - schlick(scene.f0, cos_light)) * (1.0 - schlick(scene.f0, max(dot(normal, view), view.z)));
    let entering = through / ((1.0 - scene.f0) * (20.0 / 21.0));
    return entering * painted[texel].rgb * cos_light + ggx_specular(normal, view, light, scene.roughness, scene.f0);
}

// One texel's radiance in full light, unpainted and painted mixed by coverage.
fn texel_radiance(texel: u32) -> vec3<f32> {
    let coverage = painted[texel].w;
    var radiance = vec3(0.0);
    if coverage < 1.0 {
        radiance += (1.0 - coverage) * unpainted_radiance(texel);
    }
    if coverage > 0.0 {
        radiance += coverage * painted_radiance(texel);
    }
    return radiance;
}

// Radiance of the view ray through `base`: bilinear between the four texels around its hit, times the share of
// the light seen there.
fn radiance_at(base: vec2<f32>) -> vec3<f32> {
    if scene.view.z < MIN_COSINE {
        return vec3(0.0);
    }
    let hit = first_hit(base);
    let visible = visibility(hit);
    if visible == 0.0 {
        return vec3(0.0);
    }
    let cell = cell_at(hit.place);
    let right = cell.fraction.x;
    let lower = cell.fraction.y;
    let weights = vec4((1.0 - right) * (1.0 - lower), right * (1.0 - lower), (1.0 - right) * lower, right * lower);
    var radiance = vec3(0.0);
    for (var corner = 0u; corner < 4u; corner++) {
        if weights[corner] > 0.0 {
            radiance += weights[corner] * texel_radiance(cell.texels[corner]);
        }
    }
    return visible * radiance;
}
