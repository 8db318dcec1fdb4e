// One step of Levenberg-Marquardt for each running fit of a Lafortune lobe: accept or reject the candidate, propose the next.
// Minimises E = sum_k (A (k . p_k)^n - s_k)^2 over A, the direction k and nu = ln n (Lafortune et al. 1997; thesis
// section 3.2.2, step 5), with p_k = w_i * w_o by components and s_k the mean specular residual, over the samples that
// are not masked. One thread a fit.
//
// lafortune_sums has the Gram matrix of (m, w p, l, r) with m = (k . p)^n, w = m/(k . p), l = m ln(k . p), r = A m - s;
// it holds all that the step needs: A is linear, so its best value and the objective there follow in closed form
// (variable projection: Golub and Pereyra 1973), and the Schur complement of A is the curvature of the rest. r is taken
// with the last A, so that E is a small correction of sum r^2 and no difference of large numbers. In frames (lafortune_framed_sums)
// there is a constant column, too, whose coefficient is linear and eliminated before A.
// Damping by Nielsen 1999. The scale of k, of which the largest |component| is 1, is fixed by curvature along k, exponent bounds by
// an active set.
// Twin: reference::lafortune_fit.
#import thread
#import lafortune_state
#import lafortune_gram

struct Params {
    // quads of fits in a slice's array
    quads: u32,
    slices: u32,
    // relative decrease below which a descent has converged
    tolerance: f32,
    min_exponent: f32,
    max_exponent: f32,
    _pad0: u32,
    _pad1: u32,
    _pad2: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
// [slice][quad of listed fits]
@group(0) @binding(1) var<storage, read> grams: array<Gram>;
// [start][texel]
@group(0) @binding(2) var<storage, read_write> states: array<FitState>;
// number of fits that still run, then those fits
@group(0) @binding(3) var<storage, read> listed: array<u32>;

const SIZE: u32 = 64u;
const MAX_DAMPING: f32 = 1e6;
const MIN_DAMPING: f32 = 1e-7;
// A decrease must be more than the rounding of the corrections that it rests on.
const ROUNDING: f32 = 2.4e-7;

// The sums of one fit.
struct Sums {
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
    // the constant column's of fits in frames: c^2, 0 without one, c m, c r and c g
    cc: f32,
    cm: f32,
    cr: f32,
    cg: vec4<f32>,
    // what the best constant takes off r^2
    explained: f32,
}

// The sums of the fit listed at `index`, over all slices.
fn sums_of(index: u32) -> Sums {
    let i = index % FITS;
    var sums = Sums();
    for (var slice = 0u; slice < params.slices; slice++) {
        let at = slice * params.quads + index / FITS;
        sums.mm += grams[at].mm[i];
        sums.mr += grams[at].mr[i];
        sums.rr += grams[at].rr[i];
        sums.mg += vec4(grams[at].mx[i], grams[at].my[i], grams[at].mz[i], grams[at].ml[i]);
        sums.rg += vec4(grams[at].rx[i], grams[at].ry[i], grams[at].rz[i], grams[at].rl[i]);
        sums.diagonal += vec4(grams[at].xx[i], grams[at].yy[i], grams[at].zz[i], grams[at].ll[i]);
        sums.mixed += vec4(grams[at].xy[i], grams[at].xz[i], grams[at].yz[i], grams[at].xl[i]);
        sums.mixed_nu += vec2(grams[at].yl[i], grams[at].zl[i]);
        sums.cc += grams[at].cc[i];
        sums.cm += grams[at].cm[i];
        sums.cr += grams[at].cr[i];
        sums.cg += vec4(grams[at].cx[i], grams[at].cy[i], grams[at].cz[i], grams[at].cl[i]);
    }
    if sums.cc > 0.0 {
        return without_constant(sums);
    }
    return sums;
}

// Takes what the constant column explains out of all others, as the best constant would (Frisch, Waugh 1933).
fn without_constant(sums: Sums) -> Sums {
    var rest = sums;
    let inverse = 1.0 / sums.cc;
    let cg = sums.cg * inverse;
    rest.mm -= sums.cm * sums.cm * inverse;
    if rest.mm < 1e-5 * sums.mm {
        // Nothing but a constant, to rounding.
        rest.mm = 0.0;
    }
    rest.mr -= sums.cm * sums.cr * inverse;
    rest.explained = sums.cr * sums.cr * inverse;
    rest.rr -= rest.explained;
    rest.mg -= sums.cm * cg;
    rest.rg -= sums.cr * cg;
    rest.diagonal -= sums.cg * cg;
    rest.mixed -= sums.cg.xxyx * cg.yzzw;
    rest.mixed_nu -= sums.cg.yz * cg.w;
    return rest;
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

// Takes the candidate's sums over as the new point, A at its best.
fn accept(state: ptr<function, FitState>, sums: Sums, amplitude: f32, objective: f32) {
    let scale = amplitude * (*state).candidate.w;
    let inverse = 1.0 / sums.mm;
    (*state).point = (*state).candidate;
    (*state).diagonal = scale * (scale * (sums.diagonal - sums.mg * (sums.mg * inverse)));
    (*state).mixed = scale * (scale * (sums.mixed - sums.mg.xxyx * (sums.mg.yzzw * inverse)));
    (*state).mixed_nu = scale * (scale * (sums.mixed_nu - sums.mg.yz * (sums.mg.w * inverse)));
    (*state).gradient = scale * (sums.rg + (amplitude - (*state).amplitude) * sums.mg);
    if sums.cc > 0.0 {
        (*state).constant -= (sums.cr + (amplitude - (*state).amplitude) * sums.cm) / sums.cc;
    }
    (*state).amplitude = amplitude;
    (*state).objective = objective;
}

fn propose(state: ptr<function, FitState>) {
    let point = (*state).point;
    let k = point.xyz;
    // Curvature along k, in which the objective is constant, holds the step to what turns k.
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
    let direction = k + step.xyz;
    let size = abs(direction);
    (*state).candidate = vec4(direction / max(max(size.x, size.y), size.z), exponent);
}

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let index = thread_index(group, groups, local, SIZE);
    if index >= listed[0] {
        return;
    }
    let fit = listed[1u + index];
    var state = states[fit];
    let sums = sums_of(index);
    let first = state.objective < 0.0;
    state.iterations += 1u;
    let correction = sums.mr / max(sums.mm, 1e-30);
    let amplitude = state.amplitude - correction;
    // A lobe that no sample sees, or that would have to take light away, is none.
    let is_lobe = sums.mm > 0.0 && amplitude > 0.0;
    if first && !is_lobe {
        state.status = STALLED;
        state.objective = state.energy;
        states[fit] = state;
        return;
    }
    let objective = max(sums.rr - correction * sums.mr, 0.0);
    let decrease = state.objective - objective;
    if first {
        accept(&state, sums, amplitude, objective);
    } else if is_lobe && decrease > ROUNDING * (correction * sums.mr + sums.explained) {
        let gain = decrease / max(state.foreseen, 1e-30);
        let bend = 2.0 * gain - 1.0;
        state.damping = max(state.damping * max(1.0 / 3.0, 1.0 - bend * bend * bend), MIN_DAMPING);
        state.growth = 2.0;
        if decrease <= params.tolerance * objective {
            state.status = CONVERGED;
        }
        accept(&state, sums, amplitude, objective);
    } else {
        state.damping *= state.growth;
        state.growth *= 2.0;
        if state.damping > MAX_DAMPING {
            state.status = STALLED;
        }
    }
    propose(&state);
    states[fit] = state;
}
