// Lists the texels whose Lafortune fit still runs, in their order, so that finished ones stop costing lanes of the next steps.
// One workgroup walks all texels, a workgroup's width at a time, with a prefix sum of the flags of each (Hillis, Steele 1986).
// Twin: reference::lafortune_fit, of the whole stage: its results are the same with any list that holds every running texel once.
#import lafortune_state

struct Params {
    texels: u32,
    _pad0: u32,
    _pad1: u32,
    _pad2: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [texel]
@group(0) @binding(1) var<storage, read> states: array<FitState>;
// their number, then the texels
@group(0) @binding(2) var<storage, read_write> listed: array<u32>;

const SIZE: u32 = 256u;

var<workgroup> sums: array<u32, SIZE>;

@compute @workgroup_size(SIZE)
fn main(@builtin(local_invocation_index) local: u32) {
    var before = 0u;
    for (var first = 0u; first < params.texels; first += SIZE) {
        let texel = first + local;
        var running = false;
        if texel < params.texels {
            running = states[texel].status == RUNNING;
        }
        sums[local] = u32(running);
        workgroupBarrier();
        for (var reach = 1u; reach < SIZE; reach *= 2u) {
            var left = 0u;
            if local >= reach {
                left = sums[local - reach];
            }
            workgroupBarrier();
            sums[local] += left;
            workgroupBarrier();
        }
        if running {
            listed[before + sums[local]] = texel;
        }
        before += workgroupUniformLoad(&sums[SIZE - 1u]);
    }
    if local == 0u {
        listed[0] = before;
    }
}
