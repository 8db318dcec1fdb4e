// A BTF that is compressed by local PCA (Mueller, Meseth, Klein 2003): radiance in reflectance units at any place under any view and light,
// interpolated between nine measured pairs and some texels. Twin: reference::reconstruct_lpca.
#import direction_mesh
#import texel_filter

struct CompressedBtf {
    width: u32,
    height: u32,
    boundary: u32,
    // texels that a place is interpolated from (model::TexelSamples)
    texel_samples: u32,
    clusters: u32,
    components: u32,
    // measured lights, and where their table with the views begins in `directions`: [view][light], the sample, four an element
    lights: u32,
    samples: u32,
    // meshes of views and lights in `directions`: first element, cells a side
    view_mesh: vec2<u32>,
    light_mesh: vec2<u32>,
    // where the measured lights' cosines to the plane's normal begin in `directions`, four an element, as bits of f32
    cosines: u32,
    _pad0: u32,
    _pad1: u32,
    _pad2: u32,
}

@group(0) @binding(9) var<uniform> btf: CompressedBtf;
// [sample][cluster][term], four halves (red, green, blue, 0), reflectance units; term 0 is the cluster's mean, the others its eigenvectors
@group(0) @binding(10) var<storage, read> terms: array<vec2<u32>>;
// [word][row][column]: word 0 is the cluster, the others hold two weights each as halves, the last filled up with 0
@group(0) @binding(11) var<storage, read> texels: array<u32>;

// Measured pairs around a view and a light; all weights are 0 if either is below the horizon, else they sum to 1, or to the share that is
// left of a light nearer to the horizon than those measured.
struct Pairs {
    samples: array<u32, 9>,
    weights: array<f32, 9>,
}

// What is left of the radiance of the lowest measured lights as a light sinks on to the horizon: it falls with the irradiance, by the cosine.
fn left_below(lights: DirectionWeights, light: vec3<f32>) -> f32 {
    if !lights.is_below {
        return 1.0;
    }
    var cosine = 0.0;
    for (var corner = 0u; corner < 3u; corner++) {
        let at = lights.directions[corner];
        cosine += lights.weights[corner] * bitcast<f32>(directions[btf.cosines + at / 4u][at % 4u]);
    }
    return min(light.z / max(cosine, 1e-6), 1.0);
}

fn measured_pairs(view: vec3<f32>, light: vec3<f32>) -> Pairs {
    let views = direction_weights(DirectionMesh(btf.view_mesh.x, btf.view_mesh.y), view);
    let lights = direction_weights(DirectionMesh(btf.light_mesh.x, btf.light_mesh.y), light);
    let above = select(0.0, left_below(lights, light), view.z >= 0.0 && light.z >= 0.0);
    var pairs: Pairs;
    for (var pair = 0u; pair < 9u; pair++) {
        let at = views.directions[pair / 3u] * btf.lights + lights.directions[pair % 3u];
        pairs.samples[pair] = directions[btf.samples + at / 4u][at % 4u];
        pairs.weights[pair] = above * views.weights[pair / 3u] * lights.weights[pair % 3u];
    }
    return pairs;
}

// A term of a cluster, interpolated between the pairs.
fn term_of(pairs: ptr<function, Pairs>, cluster: u32, term: u32) -> vec3<f32> {
    var sum = vec3(0.0);
    for (var pair = 0u; pair < 9u; pair++) {
        let weight = (*pairs).weights[pair];
        if weight > 0.0 {
            let packed = terms[((*pairs).samples[pair] * btf.clusters + cluster) * (1u + btf.components) + term];
            sum += weight * vec3(unpack2x16float(packed.x), unpack2x16float(packed.y).x);
        }
    }
    return sum;
}

// Index of a texel, given before the boundary.
fn texel_index(texel: vec2<i32>) -> u32 {
    return wrap(texel.y, btf.height, btf.boundary) * btf.width + wrap(texel.x, btf.width, btf.boundary);
}

// A texel's weight of an eigenvector.
fn component_weight(texel: u32, component: u32) -> f32 {
    return unpack2x16float(texels[(1u + component / 2u) * btf.width * btf.height + texel])[component % 2u];
}

// The most texels that a place is interpolated from.
const MAX_TAPS: u32 = 25u;

// Radiance that leaves a place of the base plane; black below the horizon. Eigenvectors may take it below 0, which no radiance is:
// it is held to 0 last, when all is interpolated. Texels of one cluster, as neighbours mostly are, share its terms: their weights are summed
// before a term is interpolated between the pairs, which is what takes time.
fn compressed_radiance(place: vec2<f32>, view: vec3<f32>, light: vec3<f32>) -> vec3<f32> {
    var pairs = measured_pairs(view, light);
    let footprint = footprint_at(place, btf.texel_samples);
    let taps = footprint.width * footprint.width;
    var texel: array<u32, MAX_TAPS>;
    var weight: array<f32, MAX_TAPS>;
    var total = 0.0;
    for (var index = 0u; index < taps; index++) {
        let tap = tap_at(footprint, index);
        texel[index] = texel_index(tap.texel);
        weight[index] = tap.weight;
        total += tap.weight;
    }
    var radiance = vec3(0.0);
    for (var first = 0u; first < taps; first++) {
        if weight[first] == 0.0 {
            continue;
        }
        let cluster = texels[texel[first]];
        // Taps of this cluster, as bits.
        var members = 0u;
        var share = 0.0;
        for (var index = first; index < taps; index++) {
            if weight[index] > 0.0 && texels[texel[index]] == cluster {
                members |= 1u << index;
                share += weight[index];
            }
        }
        radiance += share * term_of(&pairs, cluster, 0u);
        for (var component = 0u; component < btf.components; component++) {
            var own = 0.0;
            for (var rest = members; rest != 0u; rest &= rest - 1u) {
                let index = firstTrailingBit(rest);
                own += weight[index] * component_weight(texel[index], component);
            }
            radiance += own * term_of(&pairs, cluster, 1u + component);
        }
        for (var rest = members; rest != 0u; rest &= rest - 1u) {
            weight[firstTrailingBit(rest)] = 0.0;
        }
    }
    return max(radiance / total, vec3(0.0));
}
