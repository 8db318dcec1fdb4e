// Radiance that leaves a place of the base plane towards a view under a light, in reflectance units: pi L_o / E, E the irradiance
// on a surface that faces the light. Method sections 3, 4 and 6. The pass that imports this imports one of `unpainted_svbrdf` and
// `unpainted_lpca` too, for the bare part. Twin: reference::shade.
#import microfacet
#import relief

// [row][column]
// rgb: diffuse reflectance of the paint on what lies below it; w: coverage, how much of the texel is painted, 0 to 1
@group(0) @binding(3) var<storage, read> painted: array<vec4<f32>>;
// of the topmost paint's surface: reflectance F0 at normal incidence and GGX alpha
@group(0) @binding(4) var<storage, read> coats: array<vec2<f32>>;

// Kubelka-Munk diffuse below a coat: of the light 1 - F enters and leaves at the angles of light and view, divided by the mean
// of 1 - F over the hemisphere, so that what is not reflected is what the diffuse part gets (Kelemen, Szirmay-Kalos 2001).
// Schlick's F has the cosine-weighted mean f0 + (1 - f0)/21. A normal that turns from the view further than the base plane does
// is taken at the plane's angle: normals on a rim average in the side that is hidden, and would draw it dark.
// `visible` is the share of the light that the place sees; what comes by way of others is as on the bare material, and enters
// from everywhere.
fn painted_radiance(texel: u32, visible: f32, view: vec3<f32>, light: vec3<f32>) -> vec3<f32> {
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

// Radiance of the view ray through `base` that meets the surface at `hit`: bilinear between the four texels of the hit where they
// are painted, and by the share that is bare the unpainted material's.
fn radiance_of(base: vec2<f32>, hit: Hit, view: vec3<f32>, light: vec3<f32>) -> vec3<f32> {
    if view.z < MIN_COSINE || light.z < MIN_COSINE {
        return vec3(0.0);
    }
    let visible = visibility(hit, light);
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
                radiance += coverage * painted[texel].rgb * light.z;
            } else {
                radiance += coverage * painted_radiance(texel, visible, view, light);
            }
        }
    }
    if bare > 0.0 {
        radiance += bare * unpainted_radiance(base, hit, visible, view, light);
    }
    return radiance;
}
