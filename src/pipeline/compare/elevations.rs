//! Directions grouped by their angle to the normal.

use crate::data::Direction;

/// Rings of a grid at most; directions at more angles than this are scattered.
const MAX_RINGS: usize = 24;

/// Width in degrees of a group of scattered directions.
const WIDTH: f64 = 5.0;

/// Groups of directions of about the same θ.
#[derive(Debug)]
pub struct Elevations {
    /// θ of each group in degrees, ascending: that of a ring, to a tenth, or the middle of [`WIDTH`] degrees.
    pub thetas: Vec<f64>,
    /// The group of each direction.
    pub of: Vec<usize>,
}

impl Elevations {
    /// The rings of a grid, or groups of [`WIDTH`] degrees where there are too many.
    pub fn new(directions: &[Direction]) -> Self {
        let grouped = |group: fn(f64) -> f64| {
            // To a tenth, so that a rounded angle does not fall out of its group.
            let thetas: Vec<f64> = directions.iter().map(|direction| group((10.0 * direction.theta.to_degrees()).round() / 10.0)).collect();
            let mut distinct = thetas.clone();
            distinct.sort_unstable_by(f64::total_cmp);
            distinct.dedup();
            let of = thetas.iter().map(|theta| distinct.partition_point(|other| other < theta)).collect();
            Self { thetas: distinct, of }
        };
        let rings = grouped(|theta| theta);
        if rings.thetas.len() <= MAX_RINGS { rings } else { grouped(|theta| WIDTH * ((theta / WIDTH).floor() + 0.5)) }
    }
}
