// State of one fit between passes. The lobe is A (k . p)^n with the largest |component| of k 1, so that no power underflows where the lobe peaks: the amplitude A, which is linear, is eliminated
// at every step, and nu = ln n keeps the exponent positive.
struct FitState {
    // (k, n) of the best point so far
    point: vec4<f32>,
    // (k, n) to be tried next
    candidate: vec4<f32>,
    // curvature of the objective at `point`, of (k_x, k_y, k_z, nu): diagonal
    diagonal: vec4<f32>,
    // xy, xz, yz, x nu
    mixed: vec4<f32>,
    // half the gradient of the objective at `point`
    gradient: vec4<f32>,
    // y nu and z nu of the curvature
    mixed_nu: vec2<f32>,
    // objective at `point`, negative before the first evaluation
    objective: f32,
    // A at `point`
    amplitude: f32,
    // Marquardt's damping, its growth on a rejected step (Nielsen 1999), the decrease foreseen for the candidate
    damping: f32,
    growth: f32,
    foreseen: f32,
    // objective without any lobe: Energy's sum
    energy: f32,
    // FitStatus
    status: u32,
    // steps tried, over all descents
    iterations: u32,
    // coefficient of the constant column at `point`, of fits in frames
    constant: f32,
    _pad: u32,
}

// What a texel's fit has to go on.
struct Energy {
    // samples that are not masked
    valid: u32,
    // of their squared residuals, reflectance^2
    sum: f32,
}

const RUNNING: u32 = 0u;
const CONVERGED: u32 = 1u;
const NO_SPECULAR: u32 = 2u;
const STALLED: u32 = 3u;
const TOO_FEW_SAMPLES: u32 = 4u;

// Damping of a descent's first step: nearly that of Gauss and Newton.
const START_DAMPING: f32 = 1e-3;
