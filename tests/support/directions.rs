//! Sets of directions that are hard to triangulate, and ways over the hemisphere.

use std::f64::consts::{FRAC_PI_2, TAU};

use overpaint::data::{Direction, Grid};

use super::random::Random;

fn degrees(list: &[(f64, f64)]) -> Vec<Direction> {
    list.iter().map(|&(theta, phi)| Direction::from_degrees(theta, phi)).collect()
}

/// Names and directions: a single one, two, some on a line, all in one place, full of cocircular ones, scattered.
pub fn sets() -> Vec<(&'static str, Vec<Direction>)> {
    let grid = |name: &str| name.parse::<Grid>().expect("is a grid").directions();
    let mut random = Random::new(5);
    let mut scattered = |count: usize, low: f64, high: f64| {
        (0..count).map(|_| Direction { theta: random.between(low, high), phi: random.between(0.0, TAU) }).collect::<Vec<_>>()
    };
    let repeated = [grid("thesis51"), grid("thesis51")].concat();
    let at_horizon = (0..24).map(|index| Direction { theta: FRAC_PI_2 - 1e-9, phi: TAU * f64::from(index) / 24.0 }).collect();
    vec![
        ("the zenith", degrees(&[(0.0, 0.0)])),
        ("one", degrees(&[(40.0, 77.0)])),
        ("two", degrees(&[(10.0, 30.0), (70.0, 200.0)])),
        ("two and the zenith in line", degrees(&[(50.0, 30.0), (0.0, 0.0), (70.0, 210.0)])),
        ("in line off the zenith", degrees(&[(10.0, 0.0), (25.0, 0.0), (45.0, 0.0), (80.0, 0.0)])),
        ("on a circle", degrees(&(0..12).map(|index| (35.0, 30.0 * f64::from(index))).collect::<Vec<_>>())),
        ("all in one place", vec![Direction::from_degrees(20.0, 10.0); 5]),
        ("thesis51", grid("thesis51")),
        ("thesis51 twice", repeated),
        ("UBO81", grid("ubo81")),
        ("UBO151", grid("ubo151")),
        ("dense", grid("rings:20")),
        ("at the horizon", at_horizon),
        ("scattered", scattered(300, 0.0, FRAC_PI_2)),
        ("scattered in a cap", scattered(40, 0.0, 0.4)),
    ]
}

/// Uniform over the hemisphere, the horizon and a little below it included.
pub fn anywhere(random: &mut Random) -> Direction {
    let cosine: f64 = random.between(-0.02, 1.0);
    Direction { theta: cosine.acos(), phi: random.between(0.0, TAU) }
}
