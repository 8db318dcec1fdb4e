// rho_d and the rho_s of up to three lobes, per channel, by non-negative least squares on the radiance itself: they minimise
// sum_k (L_k - c_k (rho_d + sum_j rho_s,j m_jk))^2 over the lit samples, c the shading and m_j lobe j in the frame of the sample's
// normal, none of them below 0 (method section 3; NNLS: Lawson and Hanson 1974, chapter 23). One thread a texel.
//
// One pass sums the Gram matrix of the columns (c, c m_1, c m_2, c m_3) and what they have of each channel. The minimum is the plain
// least-squares solution over some subset of the columns. With four columns at most there are fifteen subsets, so all are tried, for
// the three channels at once, and the Karush-Kuhn-Tucker conditions say which is the minimum: no coefficient is negative, and no
// column left out would lower the error if it were let in. An active set would walk through the same subsets on a path of its own
// in each channel and texel. By first derivatives, too, single precision tells a faint lobe from none, where the errors of two subsets
// agree to the last digit.
// Twin: reference::linear_refit.
#import thread
#import octet
#import local_samples

struct Params {
    texels: u32,
    octets: u32,
    lobes: u32,
    // a lobe's column with less than this times the energy of the diffuse one is left out
    min_energy: f32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [texel], rho_d of each channel, w = 0
@group(0) @binding(6) var<storage, read_write> diffuse: array<vec4<f32>>;
// [lobe][texel], rho_s of each channel, w = 0
@group(0) @binding(7) var<storage, read_write> specular: array<vec4<f32>>;

const SIZE: u32 = 64u;
// Octets summed apart before they join the total, for less rounding.
const BLOCK: u32 = 32u;
// The squared sine between a column and the span of those before it in a subset is held to at least this: sums in single precision
// know it to 1e-6. That weighs the coefficient's own square with 1e-5 at most; and since columns and radiance are not negative, no
// coefficient times its column is longer than the radiance, so that it costs at most 1e-5 of the radiance's squares.
const MIN_PIVOT: f32 = 1e-5;
// Derivatives below this times the largest at zero are rounding. Of several subsets that hold the minimum, the first is taken.
const TOLERANCE: f32 = 1e-6;

struct Sums {
    // Gram matrix of the columns 0 to 3: diagonal; 01, 02, 03, 12; 13, 23
    diagonal: vec4<f32>,
    mixed: vec4<f32>,
    mixed_last: vec2<f32>,
    // the columns times the radiance of each channel
    red: vec4<f32>,
    green: vec4<f32>,
    blue: vec4<f32>,
}

fn add(sums: ptr<function, Sums>, other: Sums) {
    (*sums).diagonal += other.diagonal;
    (*sums).mixed += other.mixed;
    (*sums).mixed_last += other.mixed_last;
    (*sums).red += other.red;
    (*sums).green += other.green;
    (*sums).blue += other.blue;
}

fn add_sample(sums: ptr<function, Sums>, sample: u32, texel: u32, own: array<vec4<f32>, MAX_LOBES>, c: f32, rgb: vec3<f32>) {
    if c <= 0.0 || any(rgb < vec3(0.0)) {
        return;
    }
    let column = c * vec4(1.0, lobes_at(sample, texel, params.texels, own));
    (*sums).diagonal += column * column;
    (*sums).mixed += column.xxxy * column.yzwz;
    (*sums).mixed_last += column.yz * column.w;
    (*sums).red += rgb.r * column;
    (*sums).green += rgb.g * column;
    (*sums).blue += rgb.b * column;
}

fn sums_of(texel: u32) -> Sums {
    let own = lobes_of(texel, params.texels, params.lobes);
    let plane = params.octets * params.texels;
    var total = Sums();
    for (var block = 0u; block < params.octets; block += BLOCK) {
        var part = Sums();
        let end = min(block + BLOCK, params.octets);
        for (var octet = block; octet < end; octet++) {
            let at = octet * params.texels + texel;
            let c = unpack_octet(shading[at]);
            let red = unpack_octet(radiance[at]);
            let green = unpack_octet(radiance[plane + at]);
            let blue = unpack_octet(radiance[2u * plane + at]);
            let first = octet * 8u;
            for (var i = 0u; i < 4u; i++) {
                add_sample(&part, first + i, texel, own, c.low[i], vec3(red.low[i], green.low[i], blue.low[i]));
                add_sample(&part, first + 4u + i, texel, own, c.high[i], vec3(red.high[i], green.high[i], blue.high[i]));
            }
        }
        add(&total, part);
    }
    return total;
}

// A symmetric system of four unknowns for three right-hand sides, one a channel.
struct System {
    // 0 or 1
    diagonal: vec4<f32>,
    mixed: vec4<f32>,
    mixed_last: vec2<f32>,
    right: array<vec3<f32>, 4>,
}

// 1 over the length of each column; 0 for one without the energy for that.
fn scale_of(energy: vec4<f32>) -> vec4<f32> {
    let usable = energy > vec4(0.0, vec3(params.min_energy * energy.x));
    return select(vec4(0.0), inverseSqrt(select(vec4(1.0), energy, usable)), usable);
}

// The system of the columns at length 1, or 0.
fn scaled(sums: Sums, scale: vec4<f32>) -> System {
    let red = sums.red * scale;
    let green = sums.green * scale;
    let blue = sums.blue * scale;
    return System(
        select(vec4(0.0), vec4(1.0), scale > vec4(0.0)),
        sums.mixed * scale.xxxy * scale.yzwz,
        sums.mixed_last * scale.yz * scale.w,
        array(
            vec3(red.x, green.x, blue.x),
            vec3(red.y, green.y, blue.y),
            vec3(red.z, green.z, blue.z),
            vec3(red.w, green.w, blue.w),
        ),
    );
}

// The least-squares solution over the columns that are `inside` (1, otherwise 0), by L D L^T; the others' unknowns are 0.
fn solve(system: System, inside: vec4<f32>) -> array<vec3<f32>, 4> {
    let diagonal = system.diagonal * inside + (1.0 - inside);
    let mixed = system.mixed * inside.xxxy * inside.yzwz;
    let mixed_last = system.mixed_last * inside.yz * inside.w;
    let b = system.right;
    let l10 = mixed.x;
    let l20 = mixed.y;
    let l30 = mixed.z;
    let d1 = max(diagonal.y - l10 * l10, MIN_PIVOT);
    let l21 = (mixed.w - l20 * l10) / d1;
    let l31 = (mixed_last.x - l30 * l10) / d1;
    let d2 = max(diagonal.z - l20 * l20 - l21 * l21 * d1, MIN_PIVOT);
    let l32 = (mixed_last.y - l30 * l20 - l31 * l21 * d1) / d2;
    let d3 = max(diagonal.w - l30 * l30 - l31 * l31 * d1 - l32 * l32 * d2, MIN_PIVOT);
    let y0 = b[0] * inside.x;
    let y1 = b[1] * inside.y - l10 * y0;
    let y2 = b[2] * inside.z - l20 * y0 - l21 * y1;
    let y3 = b[3] * inside.w - l30 * y0 - l31 * y1 - l32 * y2;
    let x3 = y3 / d3;
    let x2 = y2 / d2 - l32 * x3;
    let x1 = y1 / d1 - l21 * x2 - l31 * x3;
    let x0 = y0 - l10 * x1 - l20 * x2 - l30 * x3;
    return array(x0, x1, x2, x3);
}

// The steepest slope, per channel, by which a column that is not `inside` would lower half the squared error.
fn violation_of(system: System, x: array<vec3<f32>, 4>, inside: vec4<f32>) -> vec3<f32> {
    let b = system.right;
    let mixed = system.mixed;
    let last = system.mixed_last;
    let outside = 1.0 - inside;
    let w0 = outside.x * (b[0] - mixed.x * x[1] - mixed.y * x[2] - mixed.z * x[3]);
    let w1 = outside.y * (b[1] - mixed.x * x[0] - mixed.w * x[2] - last.x * x[3]);
    let w2 = outside.z * (b[2] - mixed.y * x[0] - mixed.w * x[1] - last.y * x[3]);
    let w3 = outside.w * (b[3] - mixed.z * x[0] - last.x * x[1] - last.y * x[2]);
    return max(max(w0, w1), max(w2, w3));
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    if texel >= params.texels {
        return;
    }
    let sums = sums_of(texel);
    let scale = scale_of(sums.diagonal);
    let system = scaled(sums, scale);
    // Black, until a subset is better.
    var best = array<vec3<f32>, 4>();
    var least = violation_of(system, best, vec4(0.0));
    let rounding = TOLERANCE * least;
    for (var subset = 1u; subset < (2u << params.lobes); subset++) {
        let inside = select(vec4(0.0), vec4(1.0), (vec4(subset) & vec4(1u, 2u, 4u, 8u)) != vec4(0u));
        var x = solve(system, inside);
        let violation = max(violation_of(system, x, inside), rounding);
        let better = (min(min(x[0], x[1]), min(x[2], x[3])) >= vec3(0.0)) & (violation < least);
        for (var column = 0u; column < 4u; column++) {
            best[column] = select(best[column], x[column], better);
        }
        least = select(least, violation, better);
    }
    diffuse[texel] = vec4(scale.x * best[0], 0.0);
    for (var lobe = 0u; lobe < params.lobes; lobe++) {
        specular[lobe * params.texels + texel] = vec4(scale[lobe + 1u] * best[lobe + 1u], 0.0);
    }
}
