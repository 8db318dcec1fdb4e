// Lists the Lafortune fits that still run, in their order, so that finished ones stop costing lanes of the next steps.
// One workgroup walks all fits, RUN of them a thread at a time, with a prefix sum of the threads' counts (Hillis, Steele 1986).
// Twin: reference::lafortune_fit, of the whole stage: its results are the same with any list that holds every running fit once.
#import lafortune_state

struct Params {
    fits: u32,
    _pad0: u32,
    _pad1: u32,
    _pad2: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [start][texel]
@group(0) @binding(1) var<storage, read> states: array<FitState>;
// their number, then the fits
@group(0) @binding(2) var<storage, read_write> listed: array<u32>;

const SIZE: u32 = 256u;
// Fits side by side that a thread lists at a time.
const RUN: u32 = 16u;

var<workgroup> sums: array<u32, SIZE>;

@compute @workgroup_size(SIZE)
fn main(@builtin(local_invocation_index) local: u32) {
    var before = 0u;
    for (var first = 0u; first < params.fits; first += SIZE * RUN) {
        let own = first + local * RUN;
        var running = 0u;
        for (var i = 0u; i < RUN; i++) {
            if own + i < params.fits && states[own + i].status == RUNNING {
                running |= 1u << i;
            }
        }
        sums[local] = countOneBits(running);
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
        var place = 1u + before + sums[local] - countOneBits(running);
        for (var i = 0u; i < RUN; i++) {
            if (running & (1u << i)) != 0u {
                listed[place] = own + i;
                place += 1u;
            }
        }
        before += workgroupUniformLoad(&sums[SIZE - 1u]);
    }
    if local == 0u {
        listed[0] = before;
    }
}
