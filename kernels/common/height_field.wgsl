// A height field, its normals, and how it is looked at (stage::HeightField).

struct Scene {
    // unit vectors that point away from the surface, x right, y up, z out; w = 0
    view: vec4<f32>,
    light: vec4<f32>,
    width: u32,
    height: u32,
    boundary: u32,
    // switches (model::Relief)
    displace: u32,
    shadow: u32,
    // bounds of `heights`
    lowest: f32,
    highest: f32,
    // tangent of the light's angular width
    penumbra: f32,
    // the frame that the unpainted reflectance is in (model::Frame), and the number of its lobes
    frame: u32,
    lobes: u32,
    // share of the base plane's light that reaches every point by way of others (data::Svbrdf)
    ambient: f32,
    // 1 if paint is a flat colour (model::PaintMethod)
    blended: u32,
}

@group(0) @binding(0) var<uniform> scene: Scene;
// all [row][column]; texel widths, positive outwards, the paint's thickness included
@group(0) @binding(1) var<storage, read> heights: array<f32>;
// unit normals of `heights`, w = 0
@group(0) @binding(2) var<storage, read> normals: array<vec4<f32>>;
