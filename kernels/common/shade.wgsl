// Radiance that leaves a place of the base plane towards a view under a light, in reflectance units: pi L_o / E, E the irradiance
// on a surface that faces the light. Method sections 3, 4 and 6. The pass that imports this imports one of `unpainted_svbrdf` and
// `unpainted_lpca` too, for the bare part. Twin: reference::shade.
#import microfacet
#import relief

// [level][row][column], the finest level first; each has half of the columns and rows of the one before, of an odd number the smaller half
// rgb: diffuse reflectance of the paint on what lies below it; w: coverage, how much of the texel is painted, 0 to 1
@group(0) @binding(3) var<storage, read> painted: array<vec4<f32>>;
// of the topmost paint's surface: reflectance F0 at normal incidence and GGX alpha
@group(0) @binding(4) var<storage, read> coats: array<vec2<f32>>;

// GGX alpha of a texel's coat. A coarser level's normals are means, whose spread makes the surface rougher.
fn coat_alpha(texel: u32) -> f32 {
    return min(sqrt(coats[texel].y * coats[texel].y + normals[texel].w), 1.0);
}

// Of what comes out of the paint, the share that leaves to a view. A normal that turns from the view further than the base plane does is
// taken at the plane's angle: normals on a rim average in the side that is hidden, and would draw it dark.
fn leaving(texel: u32, view: vec3<f32>) -> f32 {
    return 1.0 - schlick(coats[texel].x, max(dot(normals[texel].xyz, view), view.z));
}

// Kubelka-Munk diffuse below a coat: of the light 1 - F enters and leaves at the angles of light and view, divided by the mean
// of 1 - F over the hemisphere, so that what is not reflected is what the diffuse part gets (Kelemen, Szirmay-Kalos 2001).
// Schlick's F has the cosine-weighted mean f0 + (1 - f0)/21.
// `visible` is the share of the light that the place sees; what comes by way of others is as on the bare material, and enters
// from everywhere.
fn painted_radiance(texel: u32, visible: f32, view: vec3<f32>, light: vec3<f32>) -> vec3<f32> {
    let normal = normals[texel].xyz;
    let f0 = coats[texel].x;
    let cos_light = max(dot(normal, light), 0.0);
    let entering = visible * cos_light * (1.0 - schlick(f0, cos_light)) / ((1.0 - f0) * (20.0 / 21.0));
    let lit = mix(entering, light.z, scene.ambient);
    return leaving(texel, view) * lit * painted[texel].rgb + visible * ggx_specular(normal, view, light, coat_alpha(texel), f0);
}

fn weights_of(cell: Cell) -> vec4<f32> {
    let right = cell.fraction.x;
    let lower = cell.fraction.y;
    return vec4((1.0 - right) * (1.0 - lower), right * (1.0 - lower), (1.0 - right) * lower, right * lower);
}

// The four texels around a place in a level.
fn paint_cell(place: vec2<f32>, level: u32) -> Cell {
    let finest = vec2(scene.width, scene.height);
    var size = finest;
    var begin = 0u;
    for (var finer = 0u; finer < level; finer++) {
        begin += size.x * size.y;
        size = max(size / 2u, vec2(1u));
    }
    return cell_of((place + 0.5) * vec2<f32>(size) / vec2<f32>(finest) - 0.5, size, begin);
}

// What a view ray sees: where it crosses the base plane and where it meets the surface, the four texels of a level around that with their
// bilinear weights, and how much of each weight is painted.
struct Sight {
    base: vec2<f32>,
    hit: Hit,
    cell: Cell,
    weights: vec4<f32>,
    covered: vec4<f32>,
}

fn sight_of(base: vec2<f32>, hit: Hit, level: u32) -> Sight {
    let cell = paint_cell(hit.place, level);
    let weights = weights_of(cell);
    let coverage = vec4(painted[cell.texels.x].w, painted[cell.texels.y].w, painted[cell.texels.z].w, painted[cell.texels.w].w);
    return Sight(base, hit, cell, weights, weights * coverage);
}

// Radiance of what is painted of a sight, times its share.
fn painted_part(sight: Sight, visible: f32, view: vec3<f32>, light: vec3<f32>) -> vec3<f32> {
    var radiance = vec3(0.0);
    for (var corner = 0u; corner < 4u; corner++) {
        let texel = sight.cell.texels[corner];
        let covered = sight.covered[corner];
        if covered > 0.0 {
            if scene.blended == 1u {
                // A colour in the picture, which knows of no surface.
                radiance += covered * painted[texel].rgb * light.z;
            } else {
                radiance += covered * painted_radiance(texel, visible, view, light);
            }
        }
    }
    return radiance;
}

// Radiance of what is bare, times its share.
fn bare_part(sight: Sight, visible: f32, view: vec3<f32>, light: vec3<f32>) -> vec3<f32> {
    let left = sight.weights - sight.covered;
    let bare = left.x + left.y + left.z + left.w;
    if bare > 0.0 {
        return bare * unpainted_radiance(sight.base, sight.hit, visible, view, light);
    }
    return vec3(0.0);
}

// Radiance of a sight; black at the horizon.
fn radiance_of(sight: Sight, view: vec3<f32>, light: vec3<f32>) -> vec3<f32> {
    if view.z < MIN_COSINE || light.z < MIN_COSINE {
        return vec3(0.0);
    }
    let visible = visibility(sight.hit, light);
    return painted_part(sight, visible, view, light) + bare_part(sight, visible, view, light);
}
