//! Twin of `lafortune_fit` in frames (`lafortune_framed_energy`, `lafortune_framed_sums`): the thesis' own parameters (C_x, C_y, C_z, n)
//! and the change of the diffuse part as a fifth, none of them eliminated; each step is a damped linear least-squares problem that is
//! solved on the Jacobian itself, by orthogonalisation, in f64.

use super::lafortune_gradient;
use crate::model::{FitSettings, MIN_LOBE_SAMPLES, lafortune};

/// One sample of a texel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FramedSample {
    /// ω_i ω_o by components in the frame of the normal seen ([`product_in_frame`](crate::model::product_in_frame)).
    pub product: [f64; 3],
    /// cos θ_i times the share of the light; 0 where masked or unlit.
    pub shading: f64,
    /// What the lobe is to explain of the radiance.
    pub residual: f64,
}

/// A lobe, the change of the diffuse part that comes with it, and how well they fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LafortuneFramed {
    /// (C_x, C_y, C_z, n); C = 0 and n = 1 with too few lit samples.
    pub lobe: [f64; 4],
    /// What ρ_d changes by; 0 with too few lit samples.
    pub change: f64,
    /// Mean squared residual of the lit samples, radiance².
    pub objective: f64,
}

fn lit(samples: &[FramedSample]) -> impl Iterator<Item = &FramedSample> {
    samples.iter().filter(|sample| sample.shading > 0.0)
}

/// The change of the diffuse part that suits a lobe best: Σ c (s - c lobe) / Σ c²; 0 without light.
#[must_use]
pub fn lafortune_framed_change(lobe: [f64; 4], samples: &[FramedSample]) -> f64 {
    let of = |sample: &FramedSample| sample.shading * (sample.residual - sample.shading * lafortune(lobe, sample.product));
    let energy: f64 = lit(samples).map(|sample| sample.shading.powi(2)).sum();
    if energy > 0.0 { lit(samples).map(of).sum::<f64>() / energy } else { 0.0 }
}

/// Mean of (c (lobe + change) - s)² over the lit samples; 0 without one.
#[must_use]
pub fn lafortune_framed_objective(lobe: [f64; 4], change: f64, samples: &[FramedSample]) -> f64 {
    let sum: f64 = lit(samples).map(|sample| residual(lobe, change, sample).powi(2)).sum();
    #[expect(clippy::cast_precision_loss, reason = "samples are counted in thousands")]
    let count = lit(samples).count().max(1) as f64;
    sum / count
}

fn residual(lobe: [f64; 4], change: f64, sample: &FramedSample) -> f64 {
    sample.shading * (lafortune(lobe, sample.product) + change) - sample.residual
}

/// Descends from the lobe `start` and the change that suits it (Levenberg 1944, Marquardt 1963), the exponent held to the bounds of
/// `settings`.
#[must_use]
pub fn lafortune_framed(start: [f64; 4], samples: &[FramedSample], settings: &FitSettings) -> LafortuneFramed {
    if lit(samples).count() < MIN_LOBE_SAMPLES as usize {
        let lobe = [0.0, 0.0, 0.0, 1.0];
        return LafortuneFramed { lobe, change: 0.0, objective: lafortune_framed_objective(lobe, 0.0, samples) };
    }
    let [least, greatest] = settings.exponents;
    let (mut lobe, mut change) = (start, lafortune_framed_change(start, samples));
    let mut objective = lafortune_framed_objective(lobe, change, samples);
    let mut damping = 1e-3;
    for _ in 0..1000 {
        let mut jacobian = [const { Vec::new() }; 5];
        let mut residuals = Vec::new();
        for sample in lit(samples) {
            let [x, y, z, n] = lafortune_gradient(lobe, sample.product);
            for (column, of_lobe) in jacobian.iter_mut().zip([x, y, z, n, 1.0]) {
                column.push(sample.shading * of_lobe);
            }
            residuals.push(residual(lobe, change, sample));
        }
        // Downhill of the exponent is against its gradient.
        let slope: f64 = jacobian[3].iter().zip(&residuals).map(|(column, residual)| column * residual).sum();
        if (lobe[3] <= least && slope > 0.0) || (lobe[3] >= greatest && slope < 0.0) {
            jacobian[3].fill(0.0);
        }
        let mut decrease = 0.0;
        while damping < 1e12 {
            let step = damped_step(&jacobian, &residuals, damping);
            let mut next = [0, 1, 2, 3].map(|parameter| lobe[parameter] + step[parameter]);
            next[3] = next[3].clamp(least, greatest);
            let tried = lafortune_framed_objective(next, change + step[4], samples);
            if tried < objective {
                decrease = (objective - tried) / objective;
                (lobe, change, objective) = (next, change + step[4], tried);
                damping = (damping * 0.1).max(1e-12);
                break;
            }
            damping *= 10.0;
        }
        if decrease < 1e-10 {
            break;
        }
    }
    LafortuneFramed { lobe, change, objective }
}

/// The step x that minimises |J x + r|² + damping·Σ (|J_i| x_i)², by modified Gram-Schmidt on J with a row for each parameter's damping
/// below it (Björck 1967). A parameter that nothing depends on stays.
fn damped_step(jacobian: &[Vec<f64>; 5], residuals: &[f64], damping: f64) -> [f64; 5] {
    let mut columns = jacobian.clone();
    for (index, column) in columns.iter_mut().enumerate() {
        let size = norm(column);
        column.extend((0..5).map(|row| if row == index { damping.sqrt() * size } else { 0.0 }));
    }
    let mut right: Vec<f64> = residuals.iter().map(|residual| -residual).chain([0.0; 5]).collect();
    let (mut upper, mut along) = ([[0.0; 5]; 5], [0.0; 5]);
    for index in 0..5 {
        let (done, rest) = columns.split_at_mut(index + 1);
        let column = &mut done[index];
        let size = norm(column);
        upper[index][index] = size;
        if size == 0.0 {
            continue;
        }
        column.iter_mut().for_each(|value| *value /= size);
        for (other, left) in rest.iter_mut().enumerate() {
            upper[index][index + 1 + other] = take_out(column, left);
        }
        along[index] = take_out(column, &mut right);
    }
    let mut step = [0.0; 5];
    for index in (0..5).rev().filter(|&index| upper[index][index] > 0.0) {
        let later: f64 = (index + 1..5).map(|other| upper[index][other] * step[other]).sum();
        step[index] = (along[index] - later) / upper[index][index];
    }
    step
}

fn norm(column: &[f64]) -> f64 {
    column.iter().map(|value| value * value).sum::<f64>().sqrt()
}

/// Takes the part along a unit column out of another; returns its length.
fn take_out(unit: &[f64], from: &mut [f64]) -> f64 {
    let along: f64 = unit.iter().zip(from.iter()).map(|(unit, value)| unit * value).sum();
    from.iter_mut().zip(unit).for_each(|(value, unit)| *value -= along * unit);
    along
}
