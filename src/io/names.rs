//! Directions in the names of images.

use std::sync::LazyLock;

use regex::Regex;

use crate::data::Direction;

/// A direction in millionths of a degree, so that equal ones compare equal however they are written. At the zenith φ is 0, elsewhere from 0
/// to below 360 degrees.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Angles {
    theta: i64,
    phi: i64,
}

impl Angles {
    const DEGREE: i64 = 1_000_000;

    fn new(theta: i64, phi: i64) -> Self {
        Self { theta, phi: if theta == 0 { 0 } else { phi.rem_euclid(360 * Self::DEGREE) } }
    }

    pub(super) fn direction(self) -> Direction {
        let degrees = |angle: i64| angle as f64 / Self::DEGREE as f64;
        Direction::from_degrees(degrees(self.theta), degrees(self.phi))
    }

    pub(super) fn is_above_horizon(self) -> bool {
        (0..90 * Self::DEGREE).contains(&self.theta)
    }
}

/// View and light in an image's name, if each of the four angles is there exactly once.
///
/// The base name without its extension counts: it holds θ and φ of light and view in degrees (`tl`, `pl`, `tv`, `pv`), in any order, with or
/// without decimals, whatever stands between them. At θ = 0, whatever φ, the direction is the zenith. A direction may lie below the horizon.
#[must_use]
pub fn directions_in_name(name: &str) -> Option<(Direction, Direction)> {
    angles(name).map(|(view, light)| (view.direction(), light.direction()))
}

/// As [`directions_in_name`].
pub(super) fn angles(name: &str) -> Option<(Angles, Angles)> {
    static ANGLE: LazyLock<Regex> =
        LazyLock::new(|| Regex::new(r"(?i)([tp])([lv])(-?[0-9]+(?:\.[0-9]+)?)").expect("the pattern is a constant"));
    let (stem, _) = name.rsplit('/').next()?.rsplit_once('.')?;
    let mut angles = [None; 4];
    for found in ANGLE.captures_iter(stem) {
        // A letter before it makes it part of a word.
        let start = found.get(0)?.start();
        if stem[..start].ends_with(|before: char| before.is_ascii_alphabetic()) {
            continue;
        }
        let slot = usize::from(found[2].eq_ignore_ascii_case("v")) * 2 + usize::from(found[1].eq_ignore_ascii_case("p"));
        let degrees: f64 = found[3].parse().ok()?;
        #[expect(clippy::cast_possible_truncation, reason = "saturates, far beyond any angle")]
        let angle = (degrees * Angles::DEGREE as f64).round() as i64;
        if angles[slot].replace(angle).is_some() {
            return None;
        }
    }
    let [Some(light_theta), Some(light_phi), Some(view_theta), Some(view_phi)] = angles else { return None };
    Some((Angles::new(view_theta, view_phi), Angles::new(light_theta, light_phi)))
}
