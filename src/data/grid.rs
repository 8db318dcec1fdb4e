//! Grids of directions: rings around the zenith, as measuring setups have them.

use std::str::FromStr;

use super::Direction;

/// Directions of one θ, evenly spaced.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ring {
    /// Angle to the normal, degrees.
    pub theta: f64,
    /// Number of directions.
    pub count: usize,
    /// φ of the first, degrees; the others follow 360°/count apart.
    pub start: f64,
}

const fn ring(theta: f64, count: usize, start: f64) -> Ring {
    Ring { theta, count, start }
}

/// Bonn's 81 directions.
pub const UBO81: &[Ring] =
    &[ring(0.0, 1, 0.0), ring(15.0, 6, 0.0), ring(30.0, 12, 0.0), ring(45.0, 18, 0.0), ring(60.0, 20, 0.0), ring(75.0, 24, 0.0)];

/// Bonn's 151 directions.
pub const UBO151: &[Ring] = &[
    ring(0.0, 1, 0.0),
    ring(11.0, 6, 15.0),
    ring(23.5, 12, 0.0),
    ring(30.0, 12, 15.0),
    ring(37.5, 12, 0.0),
    ring(45.0, 18, 0.0),
    ring(52.5, 18, 7.5),
    ring(60.0, 24, 0.0),
    ring(67.5, 24, 7.5),
    ring(75.0, 24, 0.0),
];

/// The 51 directions of the thesis.
pub const THESIS51: &[Ring] = &[ring(0.0, 1, 0.0), ring(17.0, 8, 0.0), ring(32.0, 12, 0.0), ring(50.0, 14, 0.0), ring(65.0, 16, 0.0)];

/// A list of directions, ring by ring.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    rings: Vec<Ring>,
}

/// A text that names no grid.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "expected zenith, ubo81, ubo151, thesis51, rings:N (N rings of 6, 12, 18, … directions up to 75 degrees, N from 1 to 30), \
     or THETA:COUNT,… in degrees such as 0:1,30:8,60:16, each THETA once, from 0 to 85, at most 4096 directions"
)]
pub struct GridError;

impl Grid {
    /// Directions of a grid at most.
    pub const MAX_DIRECTIONS: usize = 4096;

    /// The largest θ in degrees: from lower still a relief is seen over hundreds of times its height.
    pub const MAX_THETA: f64 = 85.0;

    /// The directions, in order of the rings and of φ.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "small counts")]
    pub fn directions(&self) -> Vec<Direction> {
        let ring = |ring: &Ring| {
            let Ring { theta, count, start } = *ring;
            (0..count).map(move |index| Direction::from_degrees(theta, start + 360.0 * index as f64 / count as f64))
        };
        self.rings.iter().flat_map(ring).collect()
    }
}

impl FromStr for Grid {
    type Err = GridError;

    fn from_str(text: &str) -> Result<Self, GridError> {
        let rings = match text {
            "zenith" => vec![ring(0.0, 1, 0.0)],
            "ubo81" => UBO81.to_vec(),
            "ubo151" => UBO151.to_vec(),
            "thesis51" => THESIS51.to_vec(),
            _ => match text.strip_prefix("rings:") {
                Some(count) => even(count).ok_or(GridError)?,
                None => text.split(',').map(explicit).collect::<Option<_>>().ok_or(GridError)?,
            },
        };
        let again = |(index, ring): (usize, &Ring)| rings[..index].iter().any(|before| before.theta.total_cmp(&ring.theta).is_eq());
        let directions = rings.iter().fold(0_usize, |sum, ring| sum.saturating_add(ring.count));
        if directions > Self::MAX_DIRECTIONS || rings.iter().enumerate().any(again) { Err(GridError) } else { Ok(Self { rings }) }
    }
}

/// The zenith and `count` rings of 6, 12, 18, … directions, the last at 75°.
#[expect(clippy::cast_precision_loss, reason = "small counts")]
fn even(count: &str) -> Option<Vec<Ring>> {
    let count: usize = count.parse().ok().filter(|count| (1..=30).contains(count))?;
    let rings = (1..=count).map(|index| ring(75.0 * index as f64 / count as f64, 6 * index, 0.0));
    Some([ring(0.0, 1, 0.0)].into_iter().chain(rings).collect())
}

/// `THETA:COUNT`; the zenith is one direction.
fn explicit(text: &str) -> Option<Ring> {
    let (theta, count) = text.split_once(':')?;
    let theta: f64 = theta.trim().parse().ok().filter(|theta| (0.0..=Grid::MAX_THETA).contains(theta))?;
    let count: usize = count.trim().parse().ok().filter(|&count| count > 0)?;
    (theta > 0.0 || count == 1).then_some(ring(theta.abs(), count, 0.0))
}
