//! Twin of `linear_refit`: Lawson and Hanson's active set on the columns themselves, orthogonalised, in f64.

use super::LocalSample;
use crate::model::MIN_LOBE_ENERGY;

/// Lengths below this times what they are left of are rounding.
const ROUNDING: f64 = 1e-11;
/// Columns let in at most: four of them need a handful of steps.
const MAX_STEPS: usize = 100;

/// ρ_d, then the ρ_s of each of `lobes` (C_x, C_y, C_z, n), per channel: the coefficients ≥ 0 that minimise the squared difference of
/// radiance over the samples that are lit and not masked (Lawson and Hanson 1974, chapter 23). A lobe with less than
/// [`MIN_LOBE_ENERGY`] has 0.
#[must_use]
pub fn linear_refit(samples: &[LocalSample], lobes: &[[f64; 4]]) -> Vec<[f64; 3]> {
    let lit: Vec<_> = samples.iter().filter(|sample| sample.shading > 0.0 && !sample.is_masked()).collect();
    let rows: Vec<Vec<f64>> = lit.iter().map(|sample| sample.responses(lobes)).collect();
    let mut columns: Vec<Vec<f64>> = (0..=lobes.len()).map(|column| rows.iter().map(|row| row[column]).collect()).collect();
    let least = MIN_LOBE_ENERGY * dot(&columns[0], &columns[0]);
    for column in columns.iter_mut().filter(|column| dot(column, column) <= least) {
        column.fill(0.0);
    }
    let mut found = vec![[0.0; 3]; columns.len()];
    for channel in 0..3 {
        let radiance: Vec<f64> = lit.iter().map(|sample| sample.radiance[channel]).collect();
        for (found, value) in found.iter_mut().zip(non_negative_least_squares(&columns, &radiance)) {
            found[channel] = value;
        }
    }
    found
}

/// The x ≥ 0 that minimises |b − Σ x_j column_j|.
fn non_negative_least_squares(columns: &[Vec<f64>], b: &[f64]) -> Vec<f64> {
    let mut x = vec![0.0; columns.len()];
    let mut inside = vec![false; columns.len()];
    let mut refused = vec![false; columns.len()];
    for _ in 0..MAX_STEPS {
        let mut rest = b.to_vec();
        for (column, x) in columns.iter().zip(&x) {
            rest.iter_mut().zip(column).for_each(|(rest, value)| *rest -= x * value);
        }
        // The column that would lower the error most, at length 1.
        let slopes = columns.iter().map(|column| dot(column, &rest) / length(column).max(f64::MIN_POSITIVE));
        let open = slopes.enumerate().filter(|(j, slope)| !inside[*j] && !refused[*j] && *slope > ROUNDING * length(b));
        let Some((entering, _)) = open.max_by(|a, b| a.1.total_cmp(&b.1)) else { break };
        inside[entering] = true;
        loop {
            let Some(free) = least_squares(columns, &inside, b).filter(|free| x[entering] > 0.0 || free[entering] > 0.0) else {
                // No more than rounding of what is inside.
                (inside[entering], refused[entering]) = (false, true);
                break;
            };
            // As far towards the free solution as all stay positive.
            let leaving = (0..x.len()).filter(|j| inside[*j] && free[*j] <= 0.0);
            let Some(share) = leaving.map(|j| x[j] / (x[j] - free[j])).min_by(f64::total_cmp) else {
                x = free;
                refused.fill(false);
                break;
            };
            for j in 0..x.len() {
                let blocked = inside[j] && free[j] <= 0.0 && x[j] / (x[j] - free[j]) <= share;
                x[j] = if blocked { 0.0 } else { x[j] + share * (free[j] - x[j]) };
                inside[j] &= !blocked;
            }
        }
    }
    x
}

/// The x that minimises |b − Σ x_j column_j| over the columns `inside`, 0 for the others; none where those depend on each other.
fn least_squares(columns: &[Vec<f64>], inside: &[bool], b: &[f64]) -> Option<Vec<f64>> {
    let members: Vec<usize> = (0..columns.len()).filter(|j| inside[*j]).collect();
    let mut basis: Vec<Vec<f64>> = members.iter().map(|j| columns[*j].clone()).collect();
    let mut rest = b.to_vec();
    // Q·R by modified Gram-Schmidt; what Q's columns say of b is taken out of it one by one.
    let mut r = vec![vec![0.0; members.len()]; members.len()];
    let mut of_q = vec![0.0; members.len()];
    for i in 0..members.len() {
        r[i][i] = length(&basis[i]);
        if r[i][i] <= ROUNDING.sqrt() * length(&columns[members[i]]) {
            return None;
        }
        let q: Vec<f64> = basis[i].iter().map(|value| value / r[i][i]).collect();
        for j in i + 1..members.len() {
            r[i][j] = take_out(&q, &mut basis[j]);
        }
        of_q[i] = take_out(&q, &mut rest);
    }
    let mut x = vec![0.0; columns.len()];
    for i in (0..members.len()).rev() {
        let later: f64 = (i + 1..members.len()).map(|j| r[i][j] * x[members[j]]).sum();
        x[members[i]] = (of_q[i] - later) / r[i][i];
    }
    Some(x)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn length(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

/// Takes the part along unit vector `q` out of `vector`; returns its length.
fn take_out(q: &[f64], vector: &mut [f64]) -> f64 {
    let along = dot(q, vector);
    vector.iter_mut().zip(q).for_each(|(value, q)| *value -= along * q);
    along
}
