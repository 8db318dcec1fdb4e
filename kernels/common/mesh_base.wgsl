// A mesh as the base plane of a relief (Policarpo, Oliveira, Comba 2005): a fragment is where a view ray crosses it, and has the frame in
// which the ray is followed through the relief from there. Passes that import this import `height_field` too. Twin: reference::mesh.
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

struct Fragment {
    @builtin(position) clip: vec4<f32>,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) tangent: vec3<f32>,
    @location(3) place: vec2<f32>,
    @location(4) @interpolate(flat) handedness: f32,
    // world units
    @location(5) @interpolate(flat) texel_width: f32,
    // its triangle, counted from 1; 0 stands for none
    @location(6) @interpolate(flat) triangle: u32,
}

// Place on the plane of texels, centres at whole numbers: rows run down from v's largest, the upper edge of the sheet.
fn place_of(vertex: Vertex) -> vec2<f32> {
    return vec2(vertex.u * f32(scene.width), camera.sheet.y - vertex.v * f32(scene.height)) - 0.5;
}

fn clip_of(position: vec3<f32>) -> vec4<f32> {
    let p = vec4(position, 1.0);
    return vec4(dot(camera.clip_x, p), dot(camera.clip_y, p), dot(camera.clip_z, p), dot(camera.clip_w, p));
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Fragment {
    let triangle = index / 3u * 3u;
    let a = vertices[corners[triangle]];
    let b = vertices[corners[triangle + 1u]];
    let c = vertices[corners[triangle + 2u]];
    // World units that a texel is wide: the root of the triangle's area over that in texels.
    let area = length(cross(b.position - a.position, c.position - a.position));
    let ab = place_of(b) - place_of(a);
    let ac = place_of(c) - place_of(a);
    let texels = abs(ab.x * ac.y - ab.y * ac.x);
    let own = vertices[corners[index]];
    var out: Fragment;
    out.clip = clip_of(own.position);
    out.position = own.position;
    out.normal = own.normal;
    out.tangent = own.tangent;
    out.place = place_of(own);
    out.handedness = own.handedness;
    // A triangle whose texture coordinates have no area shows one texel, and no relief.
    out.texel_width = select(0.0, sqrt(area / texels), texels > 1e-6);
    out.triangle = index / 3u + 1u;
    return out;
}

// The frame of the base plane at a fragment: material x, y and z in the world.
struct BaseFrame {
    tangent: vec3<f32>,
    bitangent: vec3<f32>,
    normal: vec3<f32>,
}

// From the back a sheet shows the same relief, mirrored.
fn base_frame(in: Fragment, front: bool) -> BaseFrame {
    let outside = normalize(in.normal);
    let tangent = normalize(in.tangent - dot(in.tangent, outside) * outside);
    return BaseFrame(tangent, in.handedness * cross(outside, tangent), select(-outside, outside, front));
}

fn in_base(frame: BaseFrame, direction: vec3<f32>) -> vec3<f32> {
    return vec3(dot(frame.tangent, direction), dot(frame.bitangent, direction), dot(frame.normal, direction));
}

fn world_of(frame: BaseFrame, direction: vec3<f32>) -> vec3<f32> {
    return direction.x * frame.tangent + direction.y * frame.bitangent + direction.z * frame.normal;
}

// The way back along a fragment's view ray.
struct Ray {
    // in the world
    towards: vec3<f32>,
    // in the frame of the base plane
    view: vec3<f32>,
}

fn ray_of(in: Fragment, frame: BaseFrame) -> Ray {
    let towards = normalize(camera.eye.xyz - camera.eye.w * in.position);
    let view = in_base(frame, towards);
    return Ray(towards, normalize(vec3(view.xy, max(view.z, LOWEST_VIEW))));
}

// Where in the world a ray meets the relief at a height.
fn met_at(in: Fragment, ray: Ray, height: f32) -> vec3<f32> {
    return in.position + ray.towards * (height * in.texel_width / ray.view.z);
}
