//! Twin of `frankot_chellappa`: the formula as it stands in the paper, P and Q transformed each for itself, and the real
//! part of the inverse, in f64.

use std::f64::consts::TAU;

use super::fft;
use crate::{
    data::Map,
    model::{Boundary, FitSettings, Fourier},
};

/// The height field in texel widths, mean zero, nearest in slope to `normals`: Z = (−iuP − ivQ)/(u² + v²), Z(0,0) = 0
/// (Frankot and Chellappa 1988).
#[must_use]
pub fn frankot_chellappa(normals: &Map<[f64; 3]>, settings: &FitSettings) -> Map<f64> {
    let (width, height) = (normals.width(), normals.height());
    let slopes = normals.map(|&normal| slopes(normal, settings.max_slope));
    let slopes = match settings.boundary {
        Boundary::Periodic => slopes,
        Boundary::Mirror => mirrored(&slopes, settings.detilt),
    };
    let p = fft(&slopes.map(|slope| [slope[0], 0.0]), Fourier::Forward);
    let q = fft(&slopes.map(|slope| [slope[1], 0.0]), Fourier::Forward);
    let z = Map::from_fn(slopes.width(), slopes.height(), |column, row| {
        if (column, row) == (0, 0) {
            return [0.0; 2];
        }
        let u = radians(column, slopes.width());
        // Rows run downwards, y upwards.
        let v = -radians(row, slopes.height());
        let (p, q) = (p[(column, row)], q[(column, row)]);
        let square = u * u + v * v;
        // −i·(a + ib) = b − ia
        [(u * p[1] + v * q[1]) / square, -(u * p[0] + v * q[0]) / square]
    });
    let z = fft(&z, Fourier::Inverse);
    Map::from_fn(width, height, |column, row| z[(column, row)][0])
}

/// (p, q) from the normal's angles: tan θ downhill, θ held to that of the steepest slope allowed.
fn slopes([x, y, z]: [f64; 3], max_slope: f64) -> [f64; 2] {
    let sideways = x.hypot(y);
    if sideways == 0.0 {
        return [0.0; 2];
    }
    let theta = sideways.atan2(z).min(max_slope.atan());
    let (sin_phi, cos_phi) = y.atan2(x).sin_cos();
    [-theta.tan() * cos_phi, -theta.tan() * sin_phi]
}

/// The slopes of the surface and its three mirror images: where x runs backwards p changes its sign, where y does q.
#[expect(clippy::cast_precision_loss, reason = "far fewer texels than 2^53")]
fn mirrored(slopes: &Map<[f64; 2]>, detilt: bool) -> Map<[f64; 2]> {
    let (width, height) = (slopes.width(), slopes.height());
    let mean = |axis: usize| slopes.values().iter().map(|slope| slope[axis]).sum::<f64>() / (width * height) as f64;
    let tilt = if detilt { [mean(0), mean(1)] } else { [0.0; 2] };
    Map::from_fn(2 * width, 2 * height, |column, row| {
        let (x, p_sign) = if column < width { (column, 1.0) } else { (2 * width - 1 - column, -1.0) };
        let (y, q_sign) = if row < height { (row, 1.0) } else { (2 * height - 1 - row, -1.0) };
        let [p, q] = slopes[(x, y)];
        [p_sign * (p - tilt[0]), q_sign * (q - tilt[1])]
    })
}

/// Radians a texel of frequency `index` of `count`, the upper half being negative frequencies.
#[expect(clippy::cast_precision_loss, reason = "far fewer texels than 2^53")]
fn radians(index: usize, count: usize) -> f64 {
    let cycles = if 2 * index <= count { index as f64 } else { index as f64 - count as f64 };
    TAU * cycles / count as f64
}
