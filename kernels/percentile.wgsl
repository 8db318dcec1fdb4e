// Exact quantile of each texel's reflectance, per channel: the order statistics around rank q(n - 1) of its n valid samples
// and numpy's linear rule between them. Radix select on the halves' bits, two a pass: eight passes of loads that
// neighbouring threads share, no workgroup memory and no atomics; a ninth finds the upper neighbour. The bits of valid
// samples, which have no sign, are in the order of their values; those of masked ones, which have, lie above them all.
// One thread a texel. Twin: reference::percentile (a sort).
#import thread

struct Params {
    texels: u32,
    octets: u32,
    samples: u32,
    _pad: u32,
}

// Where the quantile of a number of samples lies.
struct Position {
    // lower order statistic, counted from 0
    rank: u32,
    // weight of the upper one
    fraction: f32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [number of valid samples], from 0 to all
@group(0) @binding(1) var<storage, read> positions: array<Position>;
// [channel][octet][texel], halves, negative where masked
@group(0) @binding(2) var<storage, read> values: array<vec4<u32>>;
// [texel], the quantile of each channel, 0 without valid samples; w = 0
@group(0) @binding(3) var<storage, read_write> quantiles: array<vec4<f32>>;

const SIZE: u32 = 64u;

fn keys(word: u32) -> vec2<u32> {
    return vec2(word & 0xffffu, word >> 16u);
}

fn value(key: u32) -> f32 {
    return unpack2x16float(key).x;
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

// The last octet with all that follows the last sample masked.
fn mask_tail(words: vec4<u32>, count: u32) -> vec4<u32> {
    var masked = words;
    for (var i = count; i < 8u; i++) {
        masked[i / 2u] |= 0xffffu << (16u * (i & 1u));
    }
    return masked;
}

fn quantile(texel: u32, channel: u32) -> f32 {
    let start = channel * params.octets * params.texels + texel;
    let last = params.octets - 1u;
    let tail = params.samples - last * 8u;

    var prefix = 0u;
    var rank = 0u;
    var fraction = 0.0;
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
        if shift == 14i {
            // No sign: the first digit is 0 or 1.
            let valid = counts.x + counts.y;
            if valid == 0u {
                return 0.0;
            }
            rank = positions[valid].rank;
            fraction = positions[valid].fraction;
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
    if fraction > 0.0 && rank + 1u >= equal {
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
            result = lower + (value(above) - lower) * fraction;
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
