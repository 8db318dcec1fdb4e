// The samples of a tile whose reflectance stands in the frames of normals (stage::LocalSamples): a texel shows another point of the
// surface, and so another normal, under each view.
#import lafortune
#import shading_frame

// [channel][octet][texel], reflectance units, negative where masked
@group(0) @binding(1) var<storage, read> radiance: array<vec4<u32>>;
// [octet][texel], cos theta_i against the normal times the share of the light that reaches the point; 0 where masked or unlit
@group(0) @binding(2) var<storage, read> shading: array<vec4<u32>>;
// [sample, filled up to octets]
@group(0) @binding(3) var<storage, read> directions: array<SampleDirections>;
// [row][texel], unit normal of what the views of that row see of the texel, w = 0
@group(0) @binding(4) var<storage, read> normals: array<vec4<f32>>;
// [lobe][texel], (C_x, C_y, C_z, n)
@group(0) @binding(5) var<storage, read> lobes: array<vec4<f32>>;

const MAX_LOBES: u32 = 3u;
// A lobe out of all proportion is held to where sums of its squares stay finite.
const MAX_LOBE: vec3<f32> = vec3(1e12);

// The `count` lobes of a texel; those that are not there are 0 everywhere.
fn lobes_of(texel: u32, texels: u32, count: u32) -> array<vec4<f32>, MAX_LOBES> {
    var own: array<vec4<f32>, MAX_LOBES>;
    for (var lobe = 0u; lobe < count; lobe++) {
        own[lobe] = lobes[lobe * texels + texel];
    }
    return own;
}

// The texel's lobes at a sample.
fn lobes_at(sample: u32, texel: u32, texels: u32, own: array<vec4<f32>, MAX_LOBES>) -> vec3<f32> {
    let at = directions[sample];
    let product = product_in_frame(normals[at.row * texels + texel].xyz, at.view, at.light);
    return min(vec3(lafortune(own[0], product), lafortune(own[1], product), lafortune(own[2], product)), MAX_LOBE);
}
