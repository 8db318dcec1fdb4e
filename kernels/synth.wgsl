// Radiance of a material that is fully known, in reflectance units: pi L_o / E per texel of a block of the base plane z = 0, seen
// orthographically from one view under many directional lights. The view ray meets the bilinear height field (parallax, occlusion), the
// light is seen or not (hard shadows), the texel nearest to the hit reflects with the normals joined bilinearly:
// L = (rho_d + rho_s (C . (w_i * w_o))^n) cos(theta_i), all in the frame of that normal (Lafortune et al. 1997), no interreflection.
// A thread has two neighbouring texels, since halves are stored two to a word, and follows their view rays once for several lights.
// Twin: reference::synth.
#import thread
#import lafortune
#import height_march

struct Params {
    // unit vector that points away from the surface, x right, y up, z out; w = 0
    view: vec4<f32>,
    width: u32,
    height: u32,
    // upper left texel of the block
    column: u32,
    row: u32,
    block_width: u32,
    block_texels: u32,
    // samples of this view: the first, and how many
    first: u32,
    samples: u32,
    // bounds of `heights`
    lowest: f32,
    highest: f32,
    _pad0: u32,
    _pad1: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// maps are [row][column]; unit normals of `heights`, w = 0
@group(0) @binding(2) var<storage, read> normals: array<vec4<f32>>;
// rho_d per channel, reflectance
@group(0) @binding(3) var<storage, read> diffuse: array<vec4<f32>>;
// rho_s per channel, reflectance
@group(0) @binding(4) var<storage, read> specular: array<vec4<f32>>;
// (C_x, C_y, C_z, n) in the frame of the normal
@group(0) @binding(5) var<storage, read> lobes: array<vec4<f32>>;
// [sample], unit vectors that point away from the surface, w = 0
@group(0) @binding(6) var<storage, read> lights: array<vec4<f32>>;
// [sample][channel][pair of texels of the block], reflectance units, two halves a word; the last is there twice where texels are odd
@group(0) @binding(7) var<storage, read_write> radiance: array<u32>;

const SIZE: u32 = 64u;
// Lights that share a view ray.
const LIGHTS: u32 = 16u;
// Texel widths by which a light ray starts above the surface: heights up to 256 are rounded to 2e-5.
const BIAS: f32 = 0.0002;
// Directions with a cosine below this are taken for the horizon: nothing is seen from there, and no light comes.
const MIN_COSINE: f32 = 0.001;

// What a view ray sees.
struct Point {
    cell: vec2<u32>,
    fraction: vec2<f32>,
    height: f32,
    // from world to the frame of the normal, the first axis along x
    frame: mat3x3<f32>,
    // the view in that frame
    view: vec3<f32>,
    diffuse: vec3<f32>,
    specular: vec3<f32>,
    lobe: vec4<f32>,
}

fn frame_of(normal: vec3<f32>) -> mat3x3<f32> {
    let tangent = normalize(vec3(dot(normal.yz, normal.yz), -normal.x * normal.yz));
    return transpose(mat3x3(tangent, cross(normal, tangent), normal));
}

fn point_of(texel: u32) -> Point {
    let size = vec2(params.width, params.height);
    let base = vec2(params.column + texel % params.block_width, params.row + texel / params.block_width);
    // From the height of the highest place downwards.
    let run = run_of(params.view.xyz);
    let start = params.highest * run;
    let corner = floor(start);
    let n = vec2<i32>(size);
    let cell = vec2<u32>(((vec2<i32>(base) + vec2<i32>(corner)) % n + n) % n);
    let hit = march(cell, start - corner, params.highest, -run, -1.0, params.highest - params.lowest, size);

    let next = vec2(step_cell(hit.cell.x, true, size.x), step_cell(hit.cell.y, true, size.y));
    let upper = mix(normals[hit.cell.y * size.x + hit.cell.x].xyz, normals[hit.cell.y * size.x + next.x].xyz, hit.fraction.x);
    let lower = mix(normals[next.y * size.x + hit.cell.x].xyz, normals[next.y * size.x + next.x].xyz, hit.fraction.x);
    let frame = frame_of(normalize(mix(upper, lower, hit.fraction.y)));
    let nearest = select(hit.cell, next, hit.fraction >= vec2(0.5));
    let material = nearest.y * size.x + nearest.x;
    return Point(
        hit.cell,
        hit.fraction,
        bilinear(corners_of(hit.cell, size), hit.fraction),
        frame,
        frame * params.view.xyz,
        diffuse[material].rgb,
        specular[material].rgb,
        lobes[material],
    );
}

fn radiance_of(point: Point, light: vec3<f32>) -> vec3<f32> {
    let local = point.frame * light;
    if local.z <= 0.0 || light.z < MIN_COSINE {
        return vec3(0.0);
    }
    let z = point.height + BIAS;
    if z < params.highest {
        let size = vec2(params.width, params.height);
        if march(point.cell, point.fraction, z, run_of(light), 1.0, params.highest - z, size).met {
            return vec3(0.0);
        }
    }
    // A normal that turns from the view is that of an edge whose other side is seen: nothing mirrors there.
    var lobe = 0.0;
    if point.view.z > 0.0 {
        lobe = lafortune(point.lobe, local * point.view);
    }
    return (point.diffuse + point.specular * lobe) * local.z;
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let pair = thread_index(group, groups, local, SIZE);
    let pairs = (params.block_texels + 1u) / 2u;
    if pair >= pairs {
        return;
    }
    let begin = group.z * LIGHTS;
    let end = min(begin + LIGHTS, params.samples);
    let is_seen = params.view.z >= MIN_COSINE;
    var points: array<Point, 2>;
    if is_seen {
        points[0] = point_of(2u * pair);
        points[1] = point_of(min(2u * pair + 1u, params.block_texels - 1u));
    }
    for (var sample = params.first + begin; sample < params.first + end; sample++) {
        var left = vec3(0.0);
        var right = vec3(0.0);
        if is_seen {
            left = radiance_of(points[0], lights[sample].xyz);
            right = radiance_of(points[1], lights[sample].xyz);
        }
        for (var channel = 0u; channel < 3u; channel++) {
            radiance[(sample * 3u + channel) * pairs + pair] = pack2x16float(vec2(left[channel], right[channel]));
        }
    }
}
