// One step of Levenberg-Marquardt for each texel's Lafortune lobe: evaluate the candidate, accept or reject it, propose the
// next. Minimises E = sum_k (A (k . p_k)^n - s_k)^2 over A, the unit vector k and nu = ln n (Lafortune et al. 1997; thesis
// section 3.2.2, step 5), with p_k = w_i * w_o by components and s_k the mean specular residual, over the samples that
// are not masked. One thread a texel.
//
// One fused pass sums the Gram matrix of (m, w p, l, r) with m = (k . p)^n, w = m/(k . p), l = m ln(k . p), r = A m - s;
// it holds all that the step needs: A is linear, so its best value and the objective there follow in closed form
// (variable projection: Golub and Pereyra 1973), and the Schur complement of A is the curvature of the rest. r is taken
// with the last A, so that E is a small correction of sum r^2 and no difference of large numbers.
// Damping by Nielsen 1999. The gauge |k| = 1 is fixed by curvature along k, exponent bounds by an active set.
// Twin: reference::lafortune_fit.
#import thread
#import octet
#import lafortune_state

struct Params {
    texels: u32,
    octets: u32,
    // relative decrease below which a descent has converged
    tolerance: f32,
    min_exponent: f32,
    max_exponent: f32,
    _pad0: u32,
    _pad1: u32,
    _pad2: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [sample, filled up to octets], w_i * w_o by components, w = 0; zero past the last sample
@group(0) @binding(1) var<storage, read> products: array<vec4<f32>>;
// [octet][texel], mean specular residual as halves, negative where masked
@group(0) @binding(2) var<storage, read> residual: array<vec4<u32>>;
// [texel]
@group(0) @binding(3) var<storage, read_write> states: array<FitState>;
// number of texels that still run, then those texels
@group(0) @binding(4) var<storage, read> listed: array<u32>;

const SIZE: u32 = 64u;
// Octets summed apart before they join the total: keeps the rounding of a sum over n samples near sqrt(n / 256) instead
// of n units in the last place.
const BLOCK: u32 = 32u;
const MAX_DAMPING: f32 = 1e6;
const MIN_DAMPING: f32 = 1e-7;

struct Gram {
    // m^2, m r, r^2
    mm: f32,
    mr: f32,
    rr: f32,
    // m and r times g, g = (w p, l)
    mg: vec4<f32>,
    rg: vec4<f32>,
    // g g^T: diagonal; xy, xz, yz, x l; y l, z l
    diagonal: vec4<f32>,
    mixed: vec4<f32>,
    mixed_nu: vec2<f32>,
}

fn add(gram: ptr<function, Gram>, other: Gram) {
    (*gram).mm += other.mm;
    (*gram).mr += other.mr;
    (*gram).rr += other.rr;
    (*gram).mg += other.mg;
    (*gram).rg += other.rg;
    (*gram).diagonal += other.diagonal;
    (*gram).mixed += other.mixed;
    (*gram).mixed_nu += other.mixed_nu;
}

// A masked sample (s < 0) is taken as one with s = 0 that no lobe reaches, so that each of its terms is 0.
fn add_sample(gram: ptr<function, Gram>, candidate: vec4<f32>, amplitude: f32, product: vec3<f32>, s: f32) {
    let base = dot(candidate.xyz, product);
    let positive = (base > 0.0) & (s >= 0.0);
    let log_base = log2(select(1.0, base, positive));
    let m = select(0.0, exp2(candidate.w * log_base), positive);
    let w = m / select(1.0, base, positive);
    let g = vec4(w * product, m * log_base * 0.6931471805599453);
    let r = amplitude * m - max(s, 0.0);
    (*gram).mm += m * m;
    (*gram).mr += m * r;
    (*gram).rr += r * r;
    (*gram).mg += m * g;
    (*gram).rg += r * g;
    (*gram).diagonal += g * g;
    (*gram).mixed += g.xxyx * g.yzzw;
    (*gram).mixed_nu += g.yz * g.w;
}

fn gram_at(texel: u32, candidate: vec4<f32>, amplitude: f32) -> Gram {
    var total = Gram();
    for (var block = 0u; block < params.octets; block += BLOCK) {
        var part = Gram();
        let end = min(block + BLOCK, params.octets);
        for (var octet = block; octet < end; octet++) {
            let s = unpack_octet(residual[octet * params.texels + texel]);
            let first = octet * 8u;
            add_sample(&part, candidate, amplitude, products[first].xyz, s.low.x);
            add_sample(&part, candidate, amplitude, products[first + 1u].xyz, s.low.y);
            add_sample(&part, candidate, amplitude, products[first + 2u].xyz, s.low.z);
            add_sample(&part, candidate, amplitude, products[first + 3u].xyz, s.low.w);
            add_sample(&part, candidate, amplitude, products[first + 4u].xyz, s.high.x);
            add_sample(&part, candidate, amplitude, products[first + 5u].xyz, s.high.y);
            add_sample(&part, candidate, amplitude, products[first + 6u].xyz, s.high.z);
            add_sample(&part, candidate, amplitude, products[first + 7u].xyz, s.high.w);
        }
        add(&total, part);
    }
    return total;
}

// Solves the symmetric positive definite system M x = b by Cholesky. M's diagonal is 1 plus the damping, so its pivots are
// to be held against 1.
fn solve(diagonal: vec4<f32>, mixed: vec4<f32>, mixed_nu: vec2<f32>, b: vec4<f32>) -> vec4<f32> {
    // A pivot that rounding has pushed to zero: the direction is left to the damping.
    let tiny = 1e-6;
    let l00 = sqrt(max(diagonal.x, tiny));
    let l10 = mixed.x / l00;
    let l20 = mixed.y / l00;
    let l30 = mixed.w / l00;
    let l11 = sqrt(max(diagonal.y - l10 * l10, tiny));
    let l21 = (mixed.z - l20 * l10) / l11;
    let l31 = (mixed_nu.x - l30 * l10) / l11;
    let l22 = sqrt(max(diagonal.z - l20 * l20 - l21 * l21, tiny));
    let l32 = (mixed_nu.y - l30 * l20 - l31 * l21) / l22;
    let l33 = sqrt(max(diagonal.w - l30 * l30 - l31 * l31 - l32 * l32, tiny));
    let y0 = b.x / l00;
    let y1 = (b.y - l10 * y0) / l11;
    let y2 = (b.z - l20 * y0 - l21 * y1) / l22;
    let y3 = (b.w - l30 * y0 - l31 * y1 - l32 * y2) / l33;
    let x3 = y3 / l33;
    let x2 = (y2 - l32 * x3) / l22;
    let x1 = (y1 - l21 * x2 - l31 * x3) / l11;
    let x0 = (y0 - l10 * x1 - l20 * x2 - l30 * x3) / l00;
    return vec4(x0, x1, x2, x3);
}

// Takes the candidate's Gram matrix over as the new point, A at its best.
fn accept(state: ptr<function, FitState>, gram: Gram, amplitude: f32, objective: f32) {
    let scale = amplitude * (*state).candidate.w;
    let inverse = 1.0 / gram.mm;
    (*state).point = (*state).candidate;
    (*state).diagonal = scale * scale * (gram.diagonal - gram.mg * gram.mg * inverse);
    (*state).mixed = scale * scale * (gram.mixed - gram.mg.xxyx * gram.mg.yzzw * inverse);
    (*state).mixed_nu = scale * scale * (gram.mixed_nu - gram.mg.yz * gram.mg.w * inverse);
    (*state).gradient = scale * (gram.rg + (amplitude - (*state).amplitude) * gram.mg);
    (*state).amplitude = amplitude;
    (*state).objective = objective;
}

fn propose(state: ptr<function, FitState>) {
    let point = (*state).point;
    let k = point.xyz;
    // Curvature along k, in which the objective is constant, holds the step to the sphere's tangent.
    let gauge = (*state).diagonal.x + (*state).diagonal.y + (*state).diagonal.z;
    var diagonal = (*state).diagonal + vec4(gauge * k * k, 0.0);
    var mixed = (*state).mixed + vec4(gauge * k.xxy * k.yzz, 0.0);
    var mixed_nu = (*state).mixed_nu;
    var gradient = (*state).gradient;
    if (point.w <= params.min_exponent && gradient.w > 0.0) || (point.w >= params.max_exponent && gradient.w < 0.0) {
        diagonal.w = 1.0;
        mixed.w = 0.0;
        mixed_nu = vec2(0.0);
        gradient.w = 0.0;
    }
    // Marquardt's scaling by the diagonal.
    let scale = inverseSqrt(max(diagonal, vec4(1e-12 * gauge + 1e-30)));
    let damped = diagonal * scale * scale + (*state).damping;
    let step = -scale * solve(damped, mixed * scale.xxyx * scale.yzzw, mixed_nu * scale.yz * scale.w, gradient * scale);
    let curvature_step = (*state).diagonal * step
        + vec4(
            (*state).mixed.x * step.y + (*state).mixed.y * step.z + (*state).mixed.w * step.w,
            (*state).mixed.x * step.x + (*state).mixed.z * step.z + (*state).mixed_nu.x * step.w,
            (*state).mixed.y * step.x + (*state).mixed.z * step.y + (*state).mixed_nu.y * step.w,
            (*state).mixed.w * step.x + (*state).mixed_nu.x * step.y + (*state).mixed_nu.y * step.z,
        );
    (*state).foreseen = -(2.0 * dot((*state).gradient, step) + dot(step, curvature_step));
    // A factor e at most in the exponent: its logarithm is linear only so far.
    let exponent = clamp(point.w * exp(clamp(step.w, -1.0, 1.0)), params.min_exponent, params.max_exponent);
    (*state).candidate = vec4(normalize(k + step.xyz), exponent);
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let index = thread_index(group, groups, local, SIZE);
    if index >= listed[0] {
        return;
    }
    let texel = listed[1u + index];
    // The list may be some steps old.
    if states[texel].status != RUNNING {
        return;
    }
    var state = states[texel];
    let gram = gram_at(texel, state.candidate, state.amplitude);
    let first = state.objective < 0.0;
    if first && gram.mm == 0.0 {
        state.status = STALLED;
        state.objective = state.energy;
        states[texel] = state;
        return;
    }
    state.iterations += 1u;
    let correction = gram.mr / max(gram.mm, 1e-30);
    let amplitude = state.amplitude - correction;
    let objective = max(gram.rr - correction * gram.mr, 0.0);
    if first {
        accept(&state, gram, amplitude, objective);
    } else if gram.mm > 0.0 && objective < state.objective {
        let decrease = state.objective - objective;
        let gain = decrease / max(state.foreseen, 1e-30);
        let bend = 2.0 * gain - 1.0;
        state.damping = max(state.damping * max(1.0 / 3.0, 1.0 - bend * bend * bend), MIN_DAMPING);
        state.growth = 2.0;
        if decrease <= params.tolerance * objective {
            state.status = CONVERGED;
        }
        accept(&state, gram, amplitude, objective);
    } else {
        state.damping *= state.growth;
        state.growth *= 2.0;
        if state.damping > MAX_DAMPING {
            state.status = STALLED;
        }
    }
    propose(&state);
    states[texel] = state;
}
