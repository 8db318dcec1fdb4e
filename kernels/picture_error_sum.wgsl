// Joins the sums of each picture's workgroups, in a fixed order: every thread adds up its own, then the threads' sums fold. One workgroup a
// picture, a picture in each workgroup_id.z. Part of stage picture_error, twin: reference::picture_error.
#import picture_sums

struct Params {
    // workgroups of a picture
    groups: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [pair][workgroup]
@group(0) @binding(1) var<storage, read> partials: array<PictureSums>;
// [pair]
@group(0) @binding(2) var<storage, read_write> sums: array<PictureSums>;

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let pair = group.z;
    var sum = PictureSums();
    for (var index = local; index < params.groups; index += SIZE) {
        sum = joined(sum, partials[pair * params.groups + index]);
    }
    let folded = fold(local, sum);
    if local == 0u {
        sums[pair] = folded;
    }
}
