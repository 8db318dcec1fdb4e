// A mesh as the base plane of a relief (Policarpo, Oliveira, Comba 2005): where the view ray of a pixel crosses a triangle, and the frame in
// which it is followed through the relief from there. Passes that import this import `height_field` too. Twin: reference::mesh.
#import mesh_vertices

struct Camera {
    // rows of the matrix from world to clip coordinates
    clip_x: vec4<f32>,
    clip_y: vec4<f32>,
    clip_z: vec4<f32>,
    clip_w: vec4<f32>,
    // the eye's place (w = 1), or the direction towards a camera of parallel rays (w = 0)
    eye: vec4<f32>,
    lights: u32,
    // what is drawn: one of the OUTPUT constants
    output: u32,
    // 1: rays that leave the sheet before they meet the relief see through it
    silhouette: u32,
    // levels of `painted`
    levels: u32,
    // rays across a pixel, and down it, at most: where it covers several texels it has as many, up to this
    rays: u32,
    // how wide a part of a pixel the picture stands for, of one whose pixels are means of several pictures
    footprint: f32,
    // texels across and down the sheet of the mesh's texture coordinates from 0 to 1
    sheet: vec2<f32>,
    // columns and rows of the picture
    size: vec2<f32>,
    // 1: triangles are left out that turn their inner side to the eye
    outer_only: u32,
    _pad: u32,
    // factor on the environment, 0 where there is none, and cosine and sine of the angle that it has turned by about y
    environment: vec4<f32>,
}

const OUTPUT_RADIANCE: u32 = 0u;
// normal of the surface met, in the world, and distance from the eye's plane
const OUTPUT_GEOMETRY: u32 = 1u;
// coverage of paint, height met in texel widths over the base plane, column and row of the texel met
const OUTPUT_PAINT: u32 = 2u;

@group(0) @binding(12) var<uniform> camera: Camera;

// A view that a smooth normal turns away from, though the triangle is seen, counts as this low above the base plane.
const LOWEST_VIEW: f32 = 0.02;
// Cosine of a view from which on the relief's depth counts less, down to nothing at a mesh's outline: there the mesh turns away from its
// base plane, along which points would come to stand before other parts of the mesh.
const OUTLINE: f32 = 0.5;
// Bound of a vertex's share's change from a pixel to the next: of a needle this fraction of a pixel wide.
const STEEPEST: f32 = 1024.0;

// Where a view ray crosses the mesh.
struct Crossing {
    // in the world
    position: vec3<f32>,
    // of the base plane there: material x, y and z in the world
    tangent: vec3<f32>,
    bitangent: vec3<f32>,
    normal: vec3<f32>,
    // on the plane of texels, and its change from a pixel to the next to the right and downwards
    place: vec2<f32>,
    across: vec2<f32>,
    down: vec2<f32>,
    // world units
    texel_width: f32,
    // the way back to the eye, in the world and in the frame of the base plane
    towards: vec3<f32>,
    view: vec3<f32>,
}

fn clip_of(position: vec3<f32>) -> vec4<f32> {
    let p = vec4(position, 1.0);
    return vec4(dot(camera.clip_x, p), dot(camera.clip_y, p), dot(camera.clip_z, p), dot(camera.clip_w, p));
}

// Place on the plane of texels, centres at whole numbers: rows run down from v's largest, the upper edge of the sheet.
fn place_of(vertex: Vertex) -> vec2<f32> {
    return vec2(vertex.u * f32(scene.width), camera.sheet.y - vertex.v * f32(scene.height)) - 0.5;
}

// A vertex as seen about a point of the picture: clip x and y from there, and w.
fn seen_about(point: vec2<f32>, vertex: Vertex) -> vec3<f32> {
    let clip = clip_of(vertex.position);
    return vec3(clip.xy - point * clip.w, clip.w);
}

// The vector's direction; of one without a length another.
fn direction_or(vector: vec3<f32>, other: vec3<f32>) -> vec3<f32> {
    let square = dot(vector, vector);
    return select(other, vector * inverseSqrt(square), square > 1e-12);
}

// The crossing of a triangle, counted from 1, with the ray of a point of the picture, in pixels. A vertex's share is, up to a common factor,
// linear in the picture (Olano, Greer 1997); taken about the point itself, it loses the fewest digits where triangles are small.
fn crossing_of(triangle: u32, pixel: vec2<f32>) -> Crossing {
    let corners = triangle_corners(triangle - 1u);
    let a = vertex_at(corners.x);
    let b = vertex_at(corners.y);
    let c = vertex_at(corners.z);
    let point = vec2(2.0, -2.0) * pixel / camera.size + vec2(-1.0, 1.0);
    let seen_a = seen_about(point, a);
    let seen_b = seen_about(point, b);
    let seen_c = seen_about(point, c);
    // Rows: change to the right and upwards, and value, of each vertex's share.
    let planes = transpose(mat3x3(cross(seen_b, seen_c), cross(seen_c, seen_a), cross(seen_a, seen_b)));
    let sums = vec3(1.0) * planes;
    // An adapter draws corners at places of its grid, so that a pixel's middle may lie a little outside; of a needle that is far.
    let facing = select(-1.0, 1.0, sums.z > 0.0);
    let inside = max(facing * planes[2], vec3(0.0));
    let whole = dot(inside, vec3(1.0));
    let shares = select(vec3(1.0 / 3.0), inside / whole, whole > 0.0);
    let pixels = select(vec2(0.0), vec2(2.0, -2.0) / (sums.z * camera.size), sums.z != 0.0);
    let right = clamp((planes[0] - sums.x * shares) * pixels.x, vec3(-STEEPEST), vec3(STEEPEST));
    let down = clamp((planes[1] - sums.y * shares) * pixels.y, vec3(-STEEPEST), vec3(STEEPEST));

    let places = mat3x2(place_of(a), place_of(b), place_of(c));
    // World units that a texel is wide: the root of the triangle's area over that in texels. Of no texels, none: it shows one and no relief.
    let area = length(cross(b.position - a.position, c.position - a.position));
    let texels = abs(determinant(mat2x2(places[1] - places[0], places[2] - places[0])));

    var out: Crossing;
    out.position = mat3x3(a.position, b.position, c.position) * shares;
    out.place = places * shares;
    out.across = places * right;
    out.down = places * down;
    out.texel_width = select(0.0, sqrt(area / texels), texels > 1e-6);
    let outside = direction_or(mat3x3(a.normal, b.normal, c.normal) * shares, a.normal);
    let tangent = mat3x3(a.tangent, b.tangent, c.tangent) * shares;
    out.tangent = direction_or(tangent - dot(tangent, outside) * outside, a.tangent);
    out.bitangent = a.handedness * cross(outside, out.tangent);
    // From the back a sheet shows the same relief, mirrored.
    out.normal = select(-outside, outside, facing > 0.0);
    out.towards = normalize(camera.eye.xyz - camera.eye.w * out.position);
    let view = in_base(out, out.towards);
    out.view = normalize(vec3(view.xy, max(view.z, LOWEST_VIEW)));
    return out;
}

fn in_base(base: Crossing, direction: vec3<f32>) -> vec3<f32> {
    return vec3(dot(base.tangent, direction), dot(base.bitangent, direction), dot(base.normal, direction));
}

fn world_of(base: Crossing, direction: vec3<f32>) -> vec3<f32> {
    return direction.x * base.tangent + direction.y * base.bitangent + direction.z * base.normal;
}

// Where in the world the ray meets the relief at a height.
fn met_at(base: Crossing, height: f32) -> vec3<f32> {
    let reach = min(1.0 / base.view.z, base.view.z / (OUTLINE * OUTLINE));
    return base.position + base.towards * (height * base.texel_width * reach);
}
