// Gives each texel to the cluster whose affine subspace is nearest: the least of |a - m_k|^2 - |E_k^T (a - m_k)|^2, a the texel's coordinates, m_k the
// cluster's mean and E_k its orthonormal eigenvectors; of equally near ones the first. Then the texel's weights E_k^T (a - m_k) in it. One thread four
// texels, a workgroup apart. Mueller, Meseth, Klein 2003; Kambhatla, Leen 1997. Twin: reference::lpca_assign.
#import thread

struct Params {
    texels: u32,
    // quads of coordinates
    rank: u32,
    clusters: u32,
    // quads of eigenvectors
    quads: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [texel][quad of coordinates], a
@group(0) @binding(1) var<storage, read> coordinates: array<vec4<f32>>;
// [cluster][quad of coordinates], m
@group(0) @binding(2) var<storage, read> means: array<vec4<f32>>;
// [cluster][quad of eigenvectors][coordinate], a coordinate of four eigenvectors
@group(0) @binding(3) var<storage, read> eigenvectors: array<vec4<f32>>;
// [texel]
@group(0) @binding(4) var<storage, read_write> cluster_of: array<u32>;
// [texel], squared distance from the cluster's subspace
@group(0) @binding(5) var<storage, read_write> residuals: array<f32>;
// [texel][quad of eigenvectors]
@group(0) @binding(6) var<storage, read_write> weights: array<vec4<f32>>;

const SIZE: u32 = 64u;
const TEXELS: u32 = 4u;

// Four of a texel's weights in a cluster, given four of its coordinates about the mean.
fn weigh(d: vec4<f32>, at: u32) -> vec4<f32> {
    return d.x * eigenvectors[at] + d.y * eigenvectors[at + 1u] + d.z * eigenvectors[at + 2u] + d.w * eigenvectors[at + 3u];
}

// Squared distances of four texels from a cluster's subspace.
fn distances(texels: vec4<u32>, cluster: u32) -> vec4<f32> {
    var energy = vec4(0.0);
    for (var quad = 0u; quad < params.quads; quad++) {
        var w0 = vec4(0.0);
        var w1 = vec4(0.0);
        var w2 = vec4(0.0);
        var w3 = vec4(0.0);
        for (var j = 0u; j < params.rank; j++) {
            let m = means[cluster * params.rank + j];
            let d0 = coordinates[texels.x * params.rank + j] - m;
            let d1 = coordinates[texels.y * params.rank + j] - m;
            let d2 = coordinates[texels.z * params.rank + j] - m;
            let d3 = coordinates[texels.w * params.rank + j] - m;
            if quad == 0u {
                energy += vec4(dot(d0, d0), dot(d1, d1), dot(d2, d2), dot(d3, d3));
            }
            let at = ((cluster * params.quads + quad) * params.rank + j) * 4u;
            let e0 = eigenvectors[at];
            let e1 = eigenvectors[at + 1u];
            let e2 = eigenvectors[at + 2u];
            let e3 = eigenvectors[at + 3u];
            w0 += d0.x * e0 + d0.y * e1 + d0.z * e2 + d0.w * e3;
            w1 += d1.x * e0 + d1.y * e1 + d1.z * e2 + d1.w * e3;
            w2 += d2.x * e0 + d2.y * e1 + d2.z * e2 + d2.w * e3;
            w3 += d3.x * e0 + d3.y * e1 + d3.z * e2 + d3.w * e3;
        }
        energy -= vec4(dot(w0, w0), dot(w1, w1), dot(w2, w2), dot(w3, w3));
    }
    return energy;
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let first = (group.y * groups.x + group.x) * SIZE * TEXELS + local;
    if first >= params.texels {
        return;
    }
    // Past the last texel it is read again, and not written.
    let texels = min(first + SIZE * vec4(0u, 1u, 2u, 3u), vec4(params.texels - 1u));
    var least = distances(texels, 0u);
    var nearest = vec4(0u);
    for (var cluster = 1u; cluster < params.clusters; cluster++) {
        let distance = distances(texels, cluster);
        nearest = select(nearest, vec4(cluster), distance < least);
        least = min(least, distance);
    }
    for (var i = 0u; i < TEXELS; i++) {
        let texel = first + i * SIZE;
        if texel >= params.texels {
            return;
        }
        let cluster = nearest[i];
        cluster_of[texel] = cluster;
        // Rounding leaves a little less than nothing of a texel inside the subspace.
        residuals[texel] = max(least[i], 0.0);
        for (var quad = 0u; quad < params.quads; quad++) {
            var w = vec4(0.0);
            for (var j = 0u; j < params.rank; j++) {
                let d = coordinates[texel * params.rank + j] - means[cluster * params.rank + j];
                w += weigh(d, ((cluster * params.quads + quad) * params.rank + j) * 4u);
            }
            weights[texel * params.quads + quad] = w;
        }
    }
}
