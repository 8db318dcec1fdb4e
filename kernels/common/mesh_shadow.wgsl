// Shadow that a mesh throws on itself, by a map of the depths that each light sees (Williams 1978), averaged over a square of its texels
// (Reeves, Salesin, Cook 1987). Twin: reference::mesh, rays against the triangles.

struct Light {
    // towards a light at infinity (w = 0), or its place (w = 1)
    place: vec4<f32>,
    // rgb: of a surface that faces it, 1 = white reads 1; of a light with a place at distance 1
    irradiance: vec4<f32>,
    // rows of the matrix from world to clip coordinates of its shadow map
    clip_x: vec4<f32>,
    clip_y: vec4<f32>,
    clip_z: vec4<f32>,
    clip_w: vec4<f32>,
    // layer of its map in `shadows`; NO_SHADOW if it throws none
    layer: u32,
    // the side of a cube around its place that it shines through, 0 to 5 for +x, -x, +y, -y, +z, -z; ALL_AROUND if through all
    side: u32,
    // world units that a texel of its map is wide, of a light with a place at distance 1
    shadow_texel: f32,
    // 1 if it stands for a part of the environment, which paint has by other means
    bare_only: u32,
}

@group(0) @binding(13) var<storage, read> lights: array<Light>;
// [layer][row][column], 0 at the light's near plane and 1 at its far one
@group(0) @binding(16) var shadows: texture_depth_2d_array;

const NO_SHADOW: u32 = 0xffffffffu;
const ALL_AROUND: u32 = 6u;
// Shadow texels, from the place, that an average reaches at most: along the diagonal of its 4 x 4.
const REACH: f32 = 2.83;

// Whether the light shines this way, `way` from the light to the place: through the side of the cube of the longest axis.
fn shines(light: Light, way: vec3<f32>) -> bool {
    if light.side == ALL_AROUND {
        return true;
    }
    let long = abs(way);
    let axis = select(select(2u, 1u, long.y >= long.z), 0u, long.x >= long.y && long.x >= long.z);
    return light.side == 2u * axis + select(0u, 1u, way[axis] < 0.0);
}

// Share of the light that reaches a place of the mesh past its other parts. The place is moved out of the surface, whose unit normal on the
// light's side is given, by as much as the average reaches: on a plane seen at any angle that suffices.
fn mesh_visibility(light: Light, position: vec3<f32>, normal: vec3<f32>) -> f32 {
    if light.layer == NO_SHADOW {
        return 1.0;
    }
    let far = dot(light.clip_w, vec4(position, 1.0));
    let p = vec4(position + REACH * light.shadow_texel * far * normal, 1.0);
    let w = dot(light.clip_w, p);
    let clip = vec3(dot(light.clip_x, p), dot(light.clip_y, p), dot(light.clip_z, p)) / w;
    let side = i32(textureDimensions(shadows).x);
    let place = (vec2(0.5, -0.5) * clip.xy + 0.5) * f32(side) - 0.5;
    let corner = floor(place);
    let fraction = place - corner;
    // A square of 3 x 3 texels about the place covers 4 x 4, those at its edge in part.
    let across = vec4(1.0 - fraction.x, 1.0, 1.0, fraction.x);
    let down = vec4(1.0 - fraction.y, 1.0, 1.0, fraction.y);
    var sum = 0.0;
    for (var row = 0; row < 4; row++) {
        for (var column = 0; column < 4; column++) {
            let texel = clamp(vec2<i32>(corner) + vec2(column, row) - 1, vec2(0), vec2(side - 1));
            sum += select(0.0, across[column] * down[row], textureLoad(shadows, texel, light.layer, 0) >= clip.z);
        }
    }
    return sum / 9.0;
}
