// Exact quantile of each texel's reflectance, per channel: the order statistics around rank q(n - 1) and numpy's linear
// rule between them. Radix select on order-preserving 16-bit keys of the halves, two bits a pass: eight passes of loads
// that neighbouring threads share, no workgroup memory and no atomics; a ninth finds the upper neighbour.
// One thread a texel. Twin: reference::percentile (a sort).
#import thread

struct Params {
    texels: u32,
    octets: u32,
    samples: u32,
    // lower order statistic, counted from 0
    rank: u32,
    // weight of the upper one
    fraction: f32,
    _pad0: u32,
    _pad1: u32,
    _pad2: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [channel][octet][texel], halves
@group(0) @binding(1) var<storage, read> values: array<vec4<u32>>;
// [texel], the quantile of each channel, w = 0
@group(0) @binding(2) var<storage, read_write> quantiles: array<vec4<f32>>;

const SIZE: u32 = 64u;

// Two halves in a word -> two keys in the same order as the numbers.
fn keys(word: u32) -> vec2<u32> {
    let halves = vec2(word & 0xffffu, word >> 16u);
    return select(halves | vec2(0x8000u), halves ^ vec2(0xffffu), halves >= vec2(0x8000u));
}

fn value(key: u32) -> f32 {
    let half = select(key ^ 0xffffu, key ^ 0x8000u, key >= 0x8000u);
    return unpack2x16float(half).x;
}

// Adds, for one word, how many of its keys that start with `prefix` have the next digit 0, 1 and 2.
fn count_digits(word: u32, prefix: u32, shift: u32, counts: vec3<u32>) -> vec3<u32> {
    let both = keys(word);
    let digits = (both >> vec2(shift)) - vec2(prefix << 2u);
    return counts + select(vec3(0u), vec3(1u), vec3(digits.x) == vec3(0u, 1u, 2u))
        + select(vec3(0u), vec3(1u), vec3(digits.y) == vec3(0u, 1u, 2u));
}

// Smallest key above `bound`, with `smallest` so far.
fn next_above(word: u32, bound: u32, smallest: u32) -> u32 {
    let both = keys(word);
    let above = select(vec2(0xffffffffu), both, both > vec2(bound));
    return min(smallest, min(above.x, above.y));
}

// The last octet with whatever follows the last sample replaced by 0x7fff, a pattern that no number has and whose key is greatest.
fn mask_tail(words: vec4<u32>, count: u32) -> vec4<u32> {
    var masked = words;
    for (var i = count; i < 8u; i++) {
        let shift = 16u * (i & 1u);
        masked[i / 2u] = (masked[i / 2u] & ~(0xffffu << shift)) | (0x7fffu << shift);
    }
    return masked;
}

fn quantile(texel: u32, channel: u32) -> f32 {
    let start = channel * params.octets * params.texels + texel;
    let last = params.octets - 1u;
    let tail = params.samples - last * 8u;

    var prefix = 0u;
    var rank = params.rank;
    var equal = 0u;
    for (var shift = 14i; shift >= 0i; shift -= 2i) {
        var counts = vec3(0u);
        for (var octet = 0u; octet < params.octets; octet++) {
            var words = values[start + octet * params.texels];
            if octet == last {
                words = mask_tail(words, tail);
            }
            counts = count_digits(words.x, prefix, u32(shift), counts);
            counts = count_digits(words.y, prefix, u32(shift), counts);
            counts = count_digits(words.z, prefix, u32(shift), counts);
            counts = count_digits(words.w, prefix, u32(shift), counts);
        }
        var digit = 3u;
        if rank < counts.x {
            digit = 0u;
            equal = counts.x;
        } else if rank < counts.x + counts.y {
            digit = 1u;
            rank -= counts.x;
            equal = counts.y;
        } else if rank < counts.x + counts.y + counts.z {
            digit = 2u;
            rank -= counts.x + counts.y;
            equal = counts.z;
        } else {
            rank -= counts.x + counts.y + counts.z;
            // Digit 3 is not counted; 0 here only means that the upper neighbour must be looked for.
            equal = 0u;
        }
        prefix = (prefix << 2u) | digit;
    }

    let lower = value(prefix);
    var result = lower;
    if params.fraction > 0.0 && rank + 1u >= equal {
        var above = 0xffffffffu;
        var same = 0u;
        for (var octet = 0u; octet < params.octets; octet++) {
            var words = values[start + octet * params.texels];
            if octet == last {
                words = mask_tail(words, tail);
            }
            for (var i = 0u; i < 4u; i++) {
                above = next_above(words[i], prefix, above);
                let both = keys(words[i]);
                same += u32(both.x == prefix) + u32(both.y == prefix);
            }
        }
        if rank + 1u >= same {
            result = lower + (value(above) - lower) * params.fraction;
        }
    }
    return result;
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    if texel >= params.texels {
        return;
    }
    quantiles[texel] = vec4(quantile(texel, 0u), quantile(texel, 1u), quantile(texel, 2u), 0.0);
}
