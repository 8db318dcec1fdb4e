// How a texel plane goes on beyond its edge (model::Boundary): 0 repeats it, 1 mirrors it.
const MIRROR: u32 = 1u;

// The texel of 0..count that stands for any `index` under `boundary`: repeated, or mirrored with the edge texel doubled.
fn wrap(index: i32, count: u32, boundary: u32) -> u32 {
    let n = i32(count);
    if boundary == MIRROR {
        let period = 2 * n;
        let folded = ((index % period) + period) % period;
        return u32(select(folded, period - 1 - folded, folded >= n));
    }
    return u32(((index % n) + n) % n);
}
