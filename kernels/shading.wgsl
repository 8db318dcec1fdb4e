// How the seen points of a tile are lit: cos theta_i against the normal seen, times the share of the light that reaches the
// point, and a share of what falls on the base plane, by way of other points; and what reflectance is fitted to, the plain mean of the channels' radiance. Both are 0 where a sample is masked or
// unlit, so that it has no part in a sum. One thread an octet of one texel.
// Tatarchuk 2006 (soft shadows). Twin: reference::shading.
#import thread
#import octet
#import relief
#import shading_frame

struct Params {
    texels: u32,
    octets: u32,
    samples: u32,
    _pad: u32,
}

@group(0) @binding(3) var<uniform> params: Params;
// [sample, filled up to octets]
@group(0) @binding(4) var<storage, read> directions: array<SampleDirections>;
// [channel][octet][texel], radiance in reflectance units, negative where masked
@group(0) @binding(5) var<storage, read> radiance: array<vec4<u32>>;
// [row][texel], unit normals, w = 0
@group(0) @binding(6) var<storage, read> seen_normals: array<vec4<f32>>;
// [row][texel], column, row and height of the point seen
@group(0) @binding(7) var<storage, read> points: array<vec4<f32>>;
// [octet][texel], halves
@group(0) @binding(8) var<storage, read_write> shading: array<vec4<u32>>;
// [octet][texel], halves
@group(0) @binding(9) var<storage, read_write> means: array<vec4<u32>>;

const SIZE: u32 = 64u;

fn shading_of(sample: u32, texel: u32) -> f32 {
    if sample >= params.samples {
        return 0.0;
    }
    let at = directions[sample].row * params.texels + texel;
    let light = directions[sample].light;
    let cosine = dot(seen_normals[at].xyz, light);
    var direct = 0.0;
    if cosine > 0.0 {
        let point = points[at];
        direct = cosine * visibility(Hit(point.xy, point.z), light);
    }
    return mix(direct, max(light.z, 0.0), scene.ambient);
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let index = thread_index(group, groups, local, SIZE);
    let plane = params.octets * params.texels;
    if index >= plane {
        return;
    }
    let texel = index % params.texels;
    let first = (index / params.texels) * 8u;
    var lit = Octet();
    for (var i = 0u; i < 4u; i++) {
        lit.low[i] = shading_of(first + i, texel);
        lit.high[i] = shading_of(first + 4u + i, texel);
    }
    var mean = Octet();
    var least = Octet();
    for (var channel = 0u; channel < 3u; channel++) {
        let values = unpack_octet(radiance[channel * plane + index]);
        mean.low += values.low / 3.0;
        mean.high += values.high / 3.0;
        least.low = min(least.low, values.low);
        least.high = min(least.high, values.high);
    }
    lit.low = select(lit.low, vec4(0.0), least.low < vec4(0.0));
    lit.high = select(lit.high, vec4(0.0), least.high < vec4(0.0));
    mean.low = select(mean.low, vec4(0.0), lit.low == vec4(0.0));
    mean.high = select(mean.high, vec4(0.0), lit.high == vec4(0.0));
    shading[index] = pack_octet(lit);
    means[index] = pack_octet(mean);
}
