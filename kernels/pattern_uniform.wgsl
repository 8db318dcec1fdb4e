// The same drawn thickness everywhere. One thread a texel.
// Twin: reference::pattern.
#import pattern_plane

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    if outside(texel) {
        return;
    }
    drawn[params.first + texel] = params.amount;
}
