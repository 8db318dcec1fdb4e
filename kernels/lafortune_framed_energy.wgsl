// What each texel's Lafortune fit in frames has to go on: the number of its lit samples and the sum of their squared residuals.
// One thread a texel. Twin: reference::lafortune_framed, of the whole stage.
#import thread
#import octet
#import lafortune_state

struct Params {
    texels: u32,
    samples: u32,
    octets: u32,
    _pad: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [octet][texel], halves: cos theta_i times the share of the light, 0 where masked or unlit
@group(0) @binding(1) var<storage, read> shading: array<vec4<u32>>;
// [octet][texel], halves of either sign, 0 where masked or unlit
@group(0) @binding(2) var<storage, read> residual: array<vec4<u32>>;
// [texel]
@group(0) @binding(3) var<storage, read_write> energies: array<Energy>;

const SIZE: u32 = 64u;
// Octets summed apart, for less rounding.
const BLOCK: u32 = 32u;

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    if texel >= params.texels {
        return;
    }
    var lit = vec4(0u);
    var sum = 0.0;
    for (var block = 0u; block < params.octets; block += BLOCK) {
        var part = 0.0;
        let end = min(block + BLOCK, params.octets);
        for (var octet = block; octet < end; octet++) {
            let c = unpack_octet(shading[octet * params.texels + texel]);
            let s = unpack_octet(residual[octet * params.texels + texel]);
            lit += vec4<u32>(c.low > vec4(0.0)) + vec4<u32>(c.high > vec4(0.0));
            part += dot(s.low, s.low) + dot(s.high, s.high);
        }
        sum += part;
    }
    energies[texel] = Energy(lit.x + lit.y + lit.z + lit.w, sum);
}
