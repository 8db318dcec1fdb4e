// Radiance that leaves a place of the base plane towards the view, in reflectance units: pi L_o / E, E the irradiance on a
// surface that faces the light. Method sections 3, 4 and 6. Twin: reference::shade.
#import lafortune
#import microfacet
#import relief
#import shading_frame
#import surface

// Frames of the unpainted reflectance (model::Frame).
const FRAME_PLANE: u32 = 0u;
const FRAME_TEXEL: u32 = 1u;

// The measured reflectance in the frame of a normal, in the given light (cos theta_i times its share).
fn unpainted_radiance(texel: u32, normal: vec3<f32>, lit: f32) -> vec3<f32> {
    let product = product_in_frame(normal, scene.view.xyz, scene.light.xyz);
    var reflectance = diffuse[texel].rgb;
    for (var lobe = 0u; lobe < scene.lobes; lobe++) {
        let at = lobe * scene.width * scene.height + texel;
        reflectance += specular[at].rgb * lafortune(lobes[at], product);
    }
    return reflectance * lit;
}

// Kubelka-Munk diffuse below a coat: of the light 1 - F enters and leaves at the angles of light and view, divided by the mean
// of 1 - F over the hemisphere, so that what is not reflected is what the diffuse part gets (Kelemen, Szirmay-Kalos 2001).
// Schlick's F has the cosine-weighted mean f0 + (1 - f0)/21. A normal that turns from the view further than the base plane does
// is taken at the plane's angle: normals on a rim average in the side that is hidden, and would draw it dark.
// `visible` is the share of the light that the place sees; what comes by way of others is as on the bare material, and enters
// from everywhere.
fn painted_radiance(texel: u32, visible: f32) -> vec3<f32> {
    let view = scene.view.xyz;
    let light = scene.light.xyz;
    let normal = normals[texel].xyz;
    let f0 = coats[texel].x;
    let cos_light = max(dot(normal, light), 0.0);
    let entering = visible * cos_light * (1.0 - schlick(f0, cos_light)) / ((1.0 - f0) * (20.0 / 21.0));
    let lit = mix(entering, light.z, scene.ambient);
    let leaving = 1.0 - schlick(f0, max(dot(normal, view), view.z));
    return leaving * lit * painted[texel].rgb + visible * ggx_specular(normal, view, light, coats[texel].y, f0);
}

fn weights_of(cell: Cell) -> vec4<f32> {
    let right = cell.fraction.x;
    let lower = cell.fraction.y;
    return vec4((1.0 - right) * (1.0 - lower), right * (1.0 - lower), (1.0 - right) * lower, right * lower);
}

// Radiance of the view ray through `base`: bilinear between four texels, times the share of the light seen there, unpainted and
// painted mixed by coverage. Paint is where the ray meets the surface. Unpainted reflectance that was fitted in a frame of its own
// is that of the base plane's place, as a measurement has it: seen obliquely, the same place shows another point of the
// surface, whose normal is the frame's.
fn radiance_at(base: vec2<f32>) -> vec3<f32> {
    if scene.view.z < MIN_COSINE || scene.light.z < MIN_COSINE {
        return vec3(0.0);
    }
    let hit = first_hit(base, scene.view.xyz);
    let visible = visibility(hit, scene.light.xyz);
    let cell = cell_at(hit.place);
    let weights = weights_of(cell);
    var radiance = vec3(0.0);
    var bare = 0.0;
    for (var corner = 0u; corner < 4u; corner++) {
        let texel = cell.texels[corner];
        let coverage = painted[texel].w * weights[corner];
        bare += weights[corner] - coverage;
        if coverage > 0.0 {
            if scene.blended == 1u {
                // A colour in the picture, which knows of no surface.
                radiance += coverage * painted[texel].rgb * scene.light.z;
            } else {
                radiance += coverage * painted_radiance(texel, visible);
            }
        }
        if scene.frame == FRAME_PLANE && weights[corner] > coverage {
            radiance += (weights[corner] - coverage) * unpainted_radiance(texel, vec3(0.0, 0.0, 1.0), visible * scene.light.z);
        }
    }
    if scene.frame == FRAME_PLANE || bare == 0.0 {
        return radiance;
    }
    let place = select(hit.place, base, scene.frame == FRAME_TEXEL);
    let normal = normal_at(place);
    // Shadows that no frame tells are in the measured reflectance.
    let seen = select(visible, 1.0, scene.frame == FRAME_TEXEL);
    let lit = mix(seen * max(dot(normal, scene.light.xyz), 0.0), scene.light.z, scene.ambient);
    let own = cell_at(base);
    let own_weights = weights_of(own);
    for (var corner = 0u; corner < 4u; corner++) {
        if own_weights[corner] > 0.0 {
            radiance += bare * own_weights[corner] * unpainted_radiance(own.texels[corner], normal, lit);
        }
    }
    return radiance;
}
