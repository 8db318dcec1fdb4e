//! Twin of `photometric_stereo`: least squares of one texel by an orthonormal basis of the light matrix's columns, in f64.

use glam::DVec3;

use crate::data::Direction;

/// Unit normal and albedo of a texel from its radiance (RGB, reflectance units) under each light: g minimises |L·g − I|²,
/// n = g/|g|, albedo = |g| (Rushmeier, Taubin and Guéziec 1997; thesis eq. 3.1, 3.2). The lights must span space.
#[must_use]
pub fn photometric_stereo(samples: &[[f64; 3]], lights: &[Direction]) -> ([f64; 3], f64) {
    let rows: Vec<[f64; 3]> = lights.iter().map(|light| light.vector().to_array()).collect();
    let mut rest: Vec<f64> = samples.iter().map(|rgb| rgb.iter().sum::<f64>() / 3.0).collect();
    let mut columns: Vec<Vec<f64>> = (0..3).map(|axis| rows.iter().map(|row| row[axis]).collect()).collect();

    // L = Q·R by modified Gram-Schmidt; what Q's columns say of I is taken out of it one by one.
    let mut r = [[0.0; 3]; 3];
    let mut of_q = [0.0; 3];
    for axis in 0..3 {
        r[axis][axis] = dot(&columns[axis], &columns[axis]).sqrt();
        let q: Vec<f64> = columns[axis].iter().map(|value| value / r[axis][axis]).collect();
        for later in axis + 1..3 {
            r[axis][later] = take_out(&q, &mut columns[later]);
        }
        of_q[axis] = take_out(&q, &mut rest);
    }
    // R·g = Qᵀ·I from the last row up.
    let z = of_q[2] / r[2][2];
    let y = (of_q[1] - r[1][2] * z) / r[1][1];
    let x = (of_q[0] - r[0][1] * y - r[0][2] * z) / r[0][0];
    let g = DVec3::new(x, y, z);
    (g.try_normalize().unwrap_or(DVec3::Z).to_array(), g.length())
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
