//! The fit as an engineer without a GPU would write it: f32 in memory, one texel a task on all cores (rayon), loops over samples
//! in batches of eight that the compiler turns into vector instructions.
//!
//! Same parameters as the stage, A·(k·p)^n with A eliminated, same starts, all samples in every step. `exp2` and `log2` are
//! polynomials, since the library's are calls that no compiler vectorises.

#![expect(clippy::cast_possible_truncation, reason = "single precision is what this peer works in")]

use rayon::prelude::*;

/// Samples that are worked on side by side.
const LANES: usize = 8;

/// Sums of squares and products of (m, w p, l, r): the upper triangle, row by row.
const PAIRS: usize = 21;

/// Directions' products by components, in batches.
pub struct Products {
    batches: Vec<[[f32; LANES]; 3]>,
}

impl Products {
    /// From (x, y, z) of each sample; the last batch is filled up with samples that no lobe reaches.
    pub fn new(products: &[[f64; 3]]) -> Self {
        let batch = |chunk: &[[f64; 3]]| {
            [0, 1, 2].map(|axis| std::array::from_fn(|lane| chunk.get(lane).map_or(0.0, |product| product[axis] as f32)))
        };
        Self { batches: products.chunks(LANES).map(batch).collect() }
    }
}

/// log2 of normal positive numbers, to 2e-7: ln((1 + t)/(1 - t)) = 2 (t + t³/3 + …) of the mantissa.
#[inline(always)]
fn log2(x: f32) -> f32 {
    let bits = x.to_bits();
    let exponent = (bits.wrapping_sub(0x3f35_04f3) as i32) >> 23;
    let mantissa = f32::from_bits(bits.wrapping_sub((exponent << 23) as u32));
    let t = (mantissa - 1.0) / (mantissa + 1.0);
    let square = t * t;
    let series = 0.412_198_57 * square + 0.577_078_02;
    let series = series * square + 0.961_796_7;
    let series = series * square + 2.885_39;
    series * t + exponent as f32
}

/// 2^x to 2e-7, 0 below 2^-126.
#[inline(always)]
fn exp2(x: f32) -> f32 {
    let x = x.clamp(-126.0, 126.0);
    let whole = (x + 12_582_912.0) - 12_582_912.0;
    let part = x - whole;
    let series = 1.535_336_8e-4 * part + 1.339_887_4e-3;
    let series = series * part + 9.618_437e-3;
    let series = series * part + 5.550_332_5e-2;
    let series = series * part + 2.402_264_8e-1;
    let series = series * part + 6.931_472e-1;
    let series = series * part + 1.0;
    series * f32::from_bits(((whole as i32 + 127) << 23) as u32)
}

#[inline(always)]
fn sums(products: &Products, residual: &[[f32; LANES]], [kx, ky, kz, n]: [f32; 4], amplitude: f32) -> [f64; PAIRS] {
    let mut total = [0.0; PAIRS];
    // Single precision within a block, double over blocks.
    for (products, residual) in products.batches.chunks(32).zip(residual.chunks(32)) {
        let mut lanes = [[0.0f32; LANES]; PAIRS];
        for ([x, y, z], s) in products.iter().zip(residual) {
            let mut terms = [[0.0f32; LANES]; 6];
            for lane in 0..LANES {
                let base = kx * x[lane] + ky * y[lane] + kz * z[lane];
                let log_base = log2(base.max(1e-30));
                let w = if base > 0.0 { exp2((n - 1.0) * log_base) } else { 0.0 };
                let m = w * base;
                terms[0][lane] = m;
                terms[1][lane] = w * x[lane];
                terms[2][lane] = w * y[lane];
                terms[3][lane] = w * z[lane];
                terms[4][lane] = m * log_base * std::f32::consts::LN_2;
                terms[5][lane] = amplitude * m - s[lane];
            }
            let mut pair = 0;
            for row in 0..6 {
                for column in row..6 {
                    for lane in 0..LANES {
                        lanes[pair][lane] += terms[row][lane] * terms[column][lane];
                    }
                    pair += 1;
                }
            }
        }
        for (total, lanes) in total.iter_mut().zip(&lanes) {
            *total += lanes.iter().map(|&lane| f64::from(lane)).sum::<f64>();
        }
    }
    total
}

/// A point of a descent: (k, n), A, the objective, curvature by (k, ln n) and half the gradient.
#[derive(Clone, Copy)]
struct Point {
    lobe: [f32; 4],
    amplitude: f64,
    objective: f64,
    curvature: [[f64; 4]; 4],
    gradient: [f64; 4],
}

fn evaluate(products: &Products, residual: &[[f32; LANES]], lobe: [f32; 4], last: f64) -> Option<Point> {
    let sums = sums(products, residual, lobe, last as f32);
    let at = |row: usize, column: usize| sums[row * (11 - row) / 2 + column];
    if at(0, 0) <= 0.0 {
        return None;
    }
    let correction = at(0, 5) / at(0, 0);
    let amplitude = f64::from(last as f32) - correction;
    let scale = amplitude * f64::from(lobe[3]);
    let mut point =
        Point { lobe, amplitude, objective: (at(5, 5) - correction * at(0, 5)).max(0.0), curvature: [[0.0; 4]; 4], gradient: [0.0; 4] };
    for row in 0..4 {
        for column in 0..4 {
            let (low, high) = (row.min(column) + 1, row.max(column) + 1);
            point.curvature[row][column] = scale * scale * (at(low, high) - at(0, low) * at(0, high) / at(0, 0));
        }
        point.gradient[row] = scale * (at(row + 1, 5) - correction * at(0, row + 1));
    }
    Some(point)
}

fn step(point: &Point, damping: f64, [least, greatest]: [f32; 2]) -> ([f32; 4], f64) {
    let (mut matrix, mut right) =
        (nalgebra::Matrix4::from_fn(|row, column| point.curvature[row][column]), nalgebra::Vector4::from(point.gradient));
    let k: [f64; 3] = std::array::from_fn(|axis| f64::from(point.lobe[axis]));
    let gauge = matrix[(0, 0)] + matrix[(1, 1)] + matrix[(2, 2)];
    for row in 0..3 {
        for column in 0..3 {
            matrix[(row, column)] += gauge * k[row] * k[column];
        }
    }
    if (point.lobe[3] <= least && right[3] > 0.0) || (point.lobe[3] >= greatest && right[3] < 0.0) {
        for axis in 0..3 {
            matrix[(axis, 3)] = 0.0;
            matrix[(3, axis)] = 0.0;
        }
        right[3] = 0.0;
    }
    for axis in 0..4 {
        matrix[(axis, axis)] = matrix[(axis, axis)] * (1.0 + damping) + 1e-12 * gauge + 1e-30;
    }
    let step = matrix.cholesky().map_or_else(nalgebra::Vector4::zeros, |factors| -factors.solve(&right));
    let curvature = nalgebra::Matrix4::from_fn(|row, column| point.curvature[row][column]);
    let foreseen = -(2.0 * nalgebra::Vector4::from(point.gradient).dot(&step) + step.dot(&(curvature * step)));
    let moved: [f64; 3] = std::array::from_fn(|axis| k[axis] + step[axis]);
    let length = moved.iter().map(|axis| axis * axis).sum::<f64>().sqrt();
    let exponent = f64::from(point.lobe[3]) * step[3].clamp(-1.0, 1.0).exp();
    let [x, y, z] = moved.map(|axis| (axis / length) as f32);
    ([x, y, z, (exponent as f32).clamp(least, greatest)], foreseen)
}

fn descend(
    products: &Products, residual: &[[f32; LANES]], start: [f32; 4], exponents: [f32; 2], steps: u32, tolerance: f64,
) -> Option<Point> {
    let mut point = evaluate(products, residual, start, 0.0)?;
    let (mut damping, mut growth) = (1e-3, 2.0);
    for _ in 1..steps {
        let (candidate, foreseen) = step(&point, damping, exponents);
        match evaluate(products, residual, candidate, point.amplitude) {
            Some(next) if next.objective < point.objective => {
                let decrease = point.objective - next.objective;
                let bend = 2.0 * decrease / foreseen.max(1e-30) - 1.0;
                damping = (damping * (1.0 - bend * bend * bend).max(1.0 / 3.0)).max(1e-7);
                growth = 2.0;
                point = next;
                if decrease <= tolerance * point.objective {
                    break;
                }
            }
            _ => {
                damping *= growth;
                growth *= 2.0;
                if damping > 1e6 {
                    break;
                }
            }
        }
    }
    Some(point)
}

/// (C_x, C_y, C_z, n) of each texel, of residuals `[texel][sample]`.
pub fn fit(
    products: &[[f64; 3]], residuals: &[f64], starts: &[[f32; 4]], exponents: [f32; 2], steps: u32, tolerance: f64,
) -> Vec<[f64; 4]> {
    let directions = Products::new(products);
    residuals
        .par_chunks(products.len())
        .map(|residual| {
            let batch = |chunk: &[f64]| std::array::from_fn(|lane| chunk.get(lane).map_or(0.0, |&value| value as f32));
            let residual: Vec<[f32; LANES]> = residual.chunks(LANES).map(batch).collect();
            let explored = starts.iter().filter_map(|&start| descend(&directions, &residual, start, exponents, 15, 100.0 * tolerance));
            let best = explored.min_by(|a, b| a.objective.total_cmp(&b.objective))?;
            let best = descend(&directions, &residual, best.lobe, exponents, steps, tolerance)?;
            let [x, y, z, n] = best.lobe.map(f64::from);
            let scale = best.amplitude.max(0.0).powf(1.0 / n);
            Some([x * scale, y * scale, z * scale, n])
        })
        .map(|lobe| lobe.unwrap_or([0.0, 0.0, 0.0, 1.0]))
        .collect()
}
