// A mesh that wears a material: each fragment follows its view ray through the relief from where the ray crosses the mesh, which is the
// base plane there (Policarpo, Oliveira, Comba 2005), and its depth is that of the point it meets. The pass that imports this
// imports one of `unpainted_svbrdf` and `unpainted_lpca` too, for the bare part. Twin: reference::mesh.
#import shade
#import mesh_environment
#import mesh_shadow
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
}

struct Pixel {
    @builtin(frag_depth) depth: f32,
    @location(0) value: vec4<f32>,
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

// Signs of a direction's components in the material's own axes at a place: -1 along x, y where the piece is mirrored.
fn signs_at(place: vec2<f32>) -> vec3<f32> {
    if scene.boundary != MIRROR {
        return vec3(1.0);
    }
    let piece = floor((place + 0.5) / vec2(f32(scene.width), f32(scene.height)));
    return vec3(select(vec2(1.0), vec2(-1.0), abs(piece) % 2.0 == vec2(1.0)), 1.0);
}

// Radiance towards the camera of the ray through a place of the base plane.
fn seen_radiance(in: Fragment, frame: BaseFrame, base: vec2<f32>, hit: Hit, level: u32, view: vec3<f32>) -> vec3<f32> {
    let sight = sight_of(base, hit, level);
    // A mirrored piece looks as the material does under mirrored directions.
    let at_base = signs_at(base);
    let at_hit = signs_at(hit.place);
    var radiance = vec3(0.0);
    for (var index = 0u; index < camera.lights; index++) {
        let light = lights[index];
        let way = light.place.xyz - light.place.w * in.position;
        let distance2 = dot(way, way);
        if distance2 == 0.0 || !shines(light, -way) {
            continue;
        }
        let toward = in_base(frame, way * inverseSqrt(distance2));
        if toward.z < MIN_COSINE {
            continue;
        }
        let irradiance = light.irradiance.rgb / select(1.0, distance2, light.place.w == 1.0);
        let reached = mesh_visibility(light, in.position, frame.normal);
        if reached > 0.0 {
            let visible = visibility(hit, toward);
            var seen = bare_part(sight, visible, at_base * view, at_base * toward);
            if light.bare_only == 0u {
                seen += painted_part(sight, visible, at_hit * view, at_hit * toward);
            }
            radiance += reached * irradiance * seen;
        }
    }
    if camera.environment.x > 0.0 {
        let axes = mat3x3(
            at_hit.x * in_environment(frame.tangent),
            at_hit.y * in_environment(frame.bitangent),
            in_environment(frame.normal),
        );
        radiance += camera.environment.x * painted_surroundings_part(sight, at_hit * view, axes);
    }
    return radiance;
}

// A direction of the world in the environment's own frame.
fn in_environment(direction: vec3<f32>) -> vec3<f32> {
    let turn = camera.environment.yz;
    return vec3(turn.x * direction.x - turn.y * direction.z, direction.y, turn.y * direction.x + turn.x * direction.z);
}

@fragment
fn fragment(in: Fragment, @builtin(front_facing) front: bool) -> Pixel {
    let across = camera.footprint * dpdx(in.place);
    let down = camera.footprint * dpdy(in.place);
    let frame = base_frame(in, front);
    let towards = normalize(camera.eye.xyz - camera.eye.w * in.position);
    var view = in_base(frame, towards);
    view = normalize(vec3(view.xy, max(view.z, LOWEST_VIEW)));
    let hit = first_hit(in.place, view);
    if camera.silhouette == 1u {
        let inside = hit.place + 0.5;
        if any(inside < vec2(0.0)) || any(inside >= camera.sheet) {
            discard;
        }
    }
    let met = in.position + towards * (hit.height * in.texel_width / view.z);
    let clip = clip_of(met);
    var out: Pixel;
    // What lies beyond the far plane, in the deeps of the relief, is still seen: cleared pixels have 1.
    out.depth = clamp(clip.z / clip.w, 0.0, 1.0 - 6e-8);
    switch camera.output {
        case OUTPUT_GEOMETRY: {
            // Of parallel rays the plane through the origin.
            let distance = select(-dot(camera.eye.xyz, met), clip.w, camera.eye.w == 1.0);
            out.value = vec4(normalize(world_of(frame, signs_at(hit.place) * normal_at(hit.place))), distance);
        }
        case OUTPUT_PAINT: {
            let coverage = dot(sight_of(in.place, hit, 0u).covered, vec4(1.0));
            let texel = vec2<i32>(round(hit.place));
            let column = wrap(texel.x, scene.width, scene.boundary);
            let row = wrap(texel.y, scene.height, scene.boundary);
            out.value = vec4(coverage, hit.height, f32(column), f32(row));
        }
        default: {
            // Texels that the pixel covers where it covers most, spread over its rays; what a ray still covers is for the level.
            let texels = max(length(across), length(down));
            let rays = clamp(ceil(texels), 1.0, f32(camera.rays));
            let level = u32(clamp(round(log2(texels / rays)), 0.0, f32(camera.levels - 1u)));
            var sum = vec3(0.0);
            for (var row = 0.5; row < rays; row += 1.0) {
                for (var column = 0.5; column < rays; column += 1.0) {
                    let base = in.place + (column / rays - 0.5) * across + (row / rays - 0.5) * down;
                    // A lone ray is the one that has been followed.
                    var own = hit;
                    if rays > 1.0 {
                        own = first_hit(base, view);
                    }
                    sum += seen_radiance(in, frame, base, own, level, view);
                }
            }
            out.value = vec4(sum / (rays * rays), 1.0);
        }
    }
    return out;
}
