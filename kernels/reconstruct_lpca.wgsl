// What the source's camera would have recorded, from a compressed BTF: one pixel a texel on the base plane, in reflectance units.
// The terms are those of the picture's view and light already (lpca_blend). One thread a pixel.
// Mueller, Meseth, Klein 2003. Twin: reference::reconstruct_lpca.
#import thread
#import lpca

// [cluster][term], RGB in reflectance units, w = 0
@group(0) @binding(0) var<storage, read> blended: array<vec4<f32>>;
// [row][column], RGB in reflectance units, w = 1
@group(0) @binding(1) var<storage, read_write> picture: array<vec4<f32>>;

const SIZE: u32 = 64u;

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let pixel = thread_index(group, groups, local, SIZE);
    if pixel >= btf.width * btf.height {
        return;
    }
    let footprint = footprint_at(vec2(f32(pixel % btf.width), f32(pixel / btf.width)), btf.texel_samples);
    var radiance = vec3(0.0);
    var total = 0.0;
    for (var index = 0u; index < footprint.width * footprint.width; index++) {
        let tap = tap_at(footprint, index);
        if tap.weight > 0.0 {
            let texel = texel_index(tap.texel);
            let first = texels[texel] * (1u + btf.components);
            var own = blended[first].rgb;
            for (var component = 0u; component < btf.components; component++) {
                own += component_weight(texel, component) * blended[first + 1u + component].rgb;
            }
            radiance += tap.weight * own;
            total += tap.weight;
        }
    }
    picture[pixel] = vec4(max(radiance / total, vec3(0.0)), 1.0);
}
