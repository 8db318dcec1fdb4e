// How far a neighbourhood of each texel is from flat: the mean of squared slope and squared curvature over a square of texels.
// The flattest texel is the one whose lobe can stand for a rough surface's (thesis section 3.2.2). One thread a texel.
// Twin: reference::flatness.
#import thread
#import boundary
#import height_field

// [row][column], slope^2 + (curvature times a texel width)^2
@group(0) @binding(3) var<storage, read_write> roughness: array<f32>;

const SIZE: u32 = 64u;
// Texels to either side: what a texel of a measurement mixes with its neighbours, and the parallax of a small relief.
const REACH: i32 = 2;

fn at(column: i32, row: i32) -> u32 {
    return wrap(row, scene.height, scene.boundary) * scene.width + wrap(column, scene.width, scene.boundary);
}

fn bend(column: i32, row: i32) -> f32 {
    let n = normals[at(column, row)].xyz;
    let slope = n.xy / n.z;
    let around = heights[at(column - 1, row)] + heights[at(column + 1, row)] + heights[at(column, row - 1)] + heights[at(column, row + 1)];
    let curvature = around - 4.0 * heights[at(column, row)];
    return dot(slope, slope) + curvature * curvature;
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    if texel >= scene.width * scene.height {
        return;
    }
    let column = i32(texel % scene.width);
    let row = i32(texel / scene.width);
    var sum = 0.0;
    for (var y = -REACH; y <= REACH; y++) {
        for (var x = -REACH; x <= REACH; x++) {
            sum += bend(column + x, row + y);
        }
    }
    let side = f32(2 * REACH + 1);
    roughness[texel] = sum / (side * side);
}
