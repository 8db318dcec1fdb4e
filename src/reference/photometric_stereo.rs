//! Twin of `photometric_stereo`: every solution anew, by an orthonormal basis of the light matrix's columns, in f64.

use glam::DVec3;

use crate::{
    data::Direction,
    model::{StereoMethod, stereo},
};

/// Unit normal and albedo of a texel from its radiance (RGB, reflectance units; masked where the first is negative) under each
/// light: g minimises Σ w (I − l·g)², n = g/|g|, albedo = |g|; (0, 0, 1) and 0 where g = 0 or the samples do not determine it.
///
/// [`StereoMethod::LeastSquares`]: w = 1 (Rushmeier, Taubin and Guéziec 1997; thesis eq. 3.1, 3.2).
/// [`StereoMethod::Robust`]: first √I, then [`stereo::REWEIGHTS`] times lit·v/(v + r²) with v the weighted variance of the
/// last solution (Lange, Little and Taylor 1989, one degree of freedom), lit = l·n over [`stereo::TERMINATOR`], held to [0, 1].
#[must_use]
pub fn photometric_stereo(samples: &[[f64; 3]], lights: &[Direction], method: StereoMethod) -> ([f64; 3], f64) {
    let valid = samples.iter().zip(lights).filter(|([red, ..], _)| *red >= 0.0);
    let (radiance, lights): (Vec<f64>, Vec<DVec3>) = valid.map(|(rgb, light)| (rgb.iter().sum::<f64>() / 3.0, light.vector())).unzip();
    let solve = |weights: &[f64]| weighted_least_squares(&lights, &radiance, weights);

    let (first, reweights) = match method {
        StereoMethod::LeastSquares => (vec![1.0; radiance.len()], 0),
        StereoMethod::Robust => (radiance.iter().map(|radiance| radiance.sqrt()).collect(), stereo::REWEIGHTS),
    };
    let (mut g, mut variance) = solve(&first).unwrap_or_default();
    for _ in 0..reweights {
        let albedo = g.length();
        if albedo == 0.0 {
            break;
        }
        let variance_held = variance.max((stereo::NOISE * albedo).powi(2));
        let weight = |(light, radiance): (&DVec3, &f64)| {
            let predicted = light.dot(g);
            let lit = (predicted / albedo / stereo::TERMINATOR).clamp(0.0, 1.0);
            lit * variance_held / (variance_held + (radiance - predicted).powi(2))
        };
        let weights: Vec<f64> = lights.iter().zip(&radiance).map(weight).collect();
        match solve(&weights) {
            Some(next) => (g, variance) = next,
            None => break,
        }
    }
    (g.try_normalize().unwrap_or(DVec3::Z).to_array(), g.length())
}

/// The g that minimises Σ w (I − l·g)², and the weighted mean of those squares; none where the weighted lights do not span space.
fn weighted_least_squares(lights: &[DVec3], radiance: &[f64], weights: &[f64]) -> Option<(DVec3, f64)> {
    let roots: Vec<f64> = weights.iter().map(|weight| weight.sqrt()).collect();
    let mut rest: Vec<f64> = radiance.iter().zip(&roots).map(|(radiance, root)| root * radiance).collect();
    let mut columns: Vec<Vec<f64>> =
        (0..3).map(|axis| lights.iter().zip(&roots).map(|(light, root)| root * light[axis]).collect()).collect();
    let total = weights.iter().sum::<f64>();

    // √W·L = Q·R by modified Gram-Schmidt; what Q's columns say of √W·I is taken out of it one by one.
    let mut r = [[0.0; 3]; 3];
    let mut of_q = [0.0; 3];
    for axis in 0..3 {
        r[axis][axis] = dot(&columns[axis], &columns[axis]).sqrt();
        if r[axis][axis] <= stereo::MIN_SPREAD * total.sqrt() {
            return None;
        }
        let q: Vec<f64> = columns[axis].iter().map(|value| value / r[axis][axis]).collect();
        for later in axis + 1..3 {
            r[axis][later] = take_out(&q, &mut columns[later]);
        }
        of_q[axis] = take_out(&q, &mut rest);
    }
    // R·g = Qᵀ·√W·I from the last row up.
    let z = of_q[2] / r[2][2];
    let y = (of_q[1] - r[1][2] * z) / r[1][1];
    let x = (of_q[0] - r[0][1] * y - r[0][2] * z) / r[0][0];
    Some((DVec3::new(x, y, z), dot(&rest, &rest) / total))
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Takes the part along unit vector `q` out of `vector`; returns its length.
fn take_out(q: &[f64], vector: &mut [f64]) -> f64 {
    let along = dot(q, vector);
    vector.iter_mut().zip(q).for_each(|(value, q)| *value -= along * q);
    along
}
