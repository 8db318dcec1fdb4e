//! Twin of `lafortune_fit`: the thesis' own parameters (C_x, C_y, C_z, n), a stored Jacobian, Marquardt's damping, in f64.

use glam::{DMat4, DVec4};

use crate::{
    data::Samples,
    model::{FitSettings, MIN_LOBE_SAMPLES, lafortune},
};

/// A lobe and how well it fits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LafortuneFit {
    /// (C_x, C_y, C_z, n); C = 0 and n = 1 with too few valid samples.
    pub lobe: [f64; 4],
    /// Mean squared residual, reflectance².
    pub objective: f64,
}

/// Product of the directions and residual of each sample that is not masked (negative).
fn valid<'a>(s: &'a [f64], samples: &'a Samples) -> impl Iterator<Item = ([f64; 3], f64)> + 'a {
    samples.products().zip(s.iter().copied()).filter(|(_, s)| *s >= 0.0)
}

/// Mean squared difference of the lobe and the mean specular residuals `s`, one a sample and negative where masked; 0 without a valid
/// one.
#[must_use]
pub fn lafortune_objective(lobe: [f64; 4], s: &[f64], samples: &Samples) -> f64 {
    let sum: f64 = valid(s, samples).map(|(product, s)| (lafortune(lobe, product) - s).powi(2)).sum();
    #[expect(clippy::cast_precision_loss, reason = "samples are counted in thousands")]
    let count = valid(s, samples).count().max(1) as f64;
    sum / count
}

/// The gradient of the lobe by (C_x, C_y, C_z, n).
#[must_use]
pub fn lafortune_gradient(lobe: [f64; 4], product: [f64; 3]) -> [f64; 4] {
    let base: f64 = lobe.iter().zip(product).map(|(c, p)| c * p).sum();
    if base <= 0.0 {
        return [0.0; 4];
    }
    let slope = lobe[3] * base.powf(lobe[3] - 1.0);
    [slope * product[0], slope * product[1], slope * product[2], base.powf(lobe[3]) * base.ln()]
}

/// Descends from `start` (Levenberg 1944, Marquardt 1963), the exponent held to the bounds of `settings`.
#[must_use]
pub fn lafortune_fit(start: [f64; 4], s: &[f64], samples: &Samples, settings: &FitSettings) -> LafortuneFit {
    if valid(s, samples).count() < MIN_LOBE_SAMPLES as usize {
        let lobe = [0.0, 0.0, 0.0, 1.0];
        return LafortuneFit { lobe, objective: lafortune_objective(lobe, s, samples) };
    }
    let [least, greatest] = settings.exponents;
    let mut lobe = start;
    let mut objective = lafortune_objective(lobe, s, samples);
    let mut damping = 1e-3;
    for _ in 0..1000 {
        let (mut curvature, mut gradient) = (DMat4::ZERO, DVec4::ZERO);
        for (product, s) in valid(s, samples) {
            let row = DVec4::from_array(lafortune_gradient(lobe, product));
            curvature += DMat4::from_cols(row * row.x, row * row.y, row * row.z, row * row.w);
            gradient += row * (lafortune(lobe, product) - s);
        }
        if (lobe[3] <= least && gradient.w > 0.0) || (lobe[3] >= greatest && gradient.w < 0.0) {
            gradient.w = 0.0;
            curvature =
                DMat4::from_cols(curvature.x_axis.with_w(0.0), curvature.y_axis.with_w(0.0), curvature.z_axis.with_w(0.0), DVec4::W);
        }
        let mut decrease = 0.0;
        while damping < 1e12 {
            let damped = curvature + DMat4::from_diagonal(damping * curvature.diagonal() + 1e-30);
            let step = damped.inverse() * -gradient;
            let mut next = (DVec4::from_array(lobe) + step).to_array();
            next[3] = next[3].clamp(least, greatest);
            let tried = lafortune_objective(next, s, samples);
            if tried < objective {
                decrease = (objective - tried) / objective;
                (lobe, objective) = (next, tried);
                damping = (damping * 0.1).max(1e-12);
                break;
            }
            damping *= 10.0;
        }
        if decrease < 1e-10 {
            break;
        }
    }
    LafortuneFit { lobe, objective }
}
