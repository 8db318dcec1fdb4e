// Index of a thread along the first axis of a grid whose workgroups are folded over x and y (gpu::Grid).
fn thread_index(group: vec3<u32>, groups: vec3<u32>, local: u32, workgroup_threads: u32) -> u32 {
    return (group.y * groups.x + group.x) * workgroup_threads + local;
}
