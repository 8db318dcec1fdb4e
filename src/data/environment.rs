//! What surrounds a scene, as light from far away.
//!
//! The world is right-handed, y up. A picture of all directions is equirectangular, as OpenEXR (`ENVMAP_LATLONG`) and Mitsuba have it: the
//! azimuth, from +z to the right (+x), falls evenly from π at the left edge to -π at the right, the elevation from π/2 at the upper edge to
//! -π/2 at the lower. So the picture's middle is at +z, which is what the front of a thing seen from there reflects, and the picture is as
//! one sees it from inside. Rows count from the top.
//!
//! Values are in the unit of pictures: where the environment is 1 everywhere, a white Lambertian surface reads 1.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DVec3, dvec3};

use super::Map;

/// What keeps values from being an environment.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum EnvironmentError {
    /// Too few or too many columns or rows.
    #[error(
        "an environment of {width} x {height} texels; expected at least 2 x 1, at most {most} in a row or column and {texels} in all: crop or \
         reduce it, to twice as wide as high for square texels"
    )]
    Size {
        /// Columns.
        width: usize,
        /// Rows.
        height: usize,
        /// Columns or rows at most.
        most: usize,
        /// Texels at most.
        texels: usize,
    },
    /// A value that is no radiance.
    #[error("the environment's texel in column {column}, row {row} has the value {value}; expected a number from 0 to {most:e}")]
    Radiance {
        /// Column of the texel.
        column: usize,
        /// Row of the texel.
        row: usize,
        /// The value.
        value: f32,
        /// The largest that is taken.
        most: f32,
    },
}

/// An environment map: linear RGB, `[row][column]`, for the directions see the module.
#[derive(Debug, Clone, PartialEq)]
pub struct Environment {
    radiance: Map<[f32; 3]>,
}

impl Environment {
    /// The most columns or rows.
    pub const MAX_SIDE: usize = 1 << 15;
    /// The most texels.
    pub const MAX_TEXELS: usize = 1 << 26;
    /// The largest value: far above the sun's in any unit, far enough below the largest number that sums over all texels stay numbers.
    pub const MAX_RADIANCE: f32 = 1e20;

    /// An environment of these values.
    ///
    /// # Errors
    /// [`EnvironmentError`] if there are too few or too many, or one is negative, too large, or not a number.
    pub fn new(radiance: Map<[f32; 3]>) -> Result<Self, EnvironmentError> {
        let width = radiance.width();
        Self::check_size([width, radiance.height()])?;
        let is_radiance = |value: &f32| (0.0..=Self::MAX_RADIANCE).contains(value);
        for (texel, rgb) in radiance.values().iter().enumerate() {
            if let Some(&value) = rgb.iter().find(|value| !is_radiance(value)) {
                let (column, row) = (texel % width, texel / width);
                return Err(EnvironmentError::Radiance { column, row, value, most: Self::MAX_RADIANCE });
            }
        }
        Ok(Self { radiance })
    }

    /// Whether an environment may have so many columns and rows.
    ///
    /// # Errors
    /// [`EnvironmentError::Size`] if not.
    pub fn check_size([width, height]: [usize; 2]) -> Result<(), EnvironmentError> {
        let (most, texels) = (Self::MAX_SIDE, Self::MAX_TEXELS);
        if (2..=most).contains(&width) && (1..=most).contains(&height) && width * height <= texels {
            Ok(())
        } else {
            Err(EnvironmentError::Size { width, height, most, texels })
        }
    }

    /// The same from all directions.
    ///
    /// # Errors
    /// [`EnvironmentError::Radiance`] if a value is negative, too large, or not a number.
    pub fn uniform(radiance: [f32; 3]) -> Result<Self, EnvironmentError> {
        Self::new(Map::from_fn(2, 1, |_, _| radiance))
    }

    /// A photographer's studio: a large soft box from the upper left of +z, a weaker one from the right, a bright strip from behind, in gray
    /// that grows lighter upwards. A white surface that faces +z reads 0.9.
    #[must_use]
    pub fn studio() -> Self {
        // Azimuth, elevation in degrees; half of width and height as tangents; value.
        let boxes = [([-40.0, 40.0], [0.45, 0.45], 5.0), ([75.0, 15.0], [0.3, 0.7], 2.0), ([165.0, 30.0], [0.08, 0.6], 12.0)];
        Self::procedural(|direction| {
            let lit = boxes.iter().map(|&(angles, half, value)| value * soft_box(angles, half, direction)).sum::<f64>();
            [0.2 + 0.1 * direction.y + lit; 3]
        })
    }

    /// A clear day: a blue sky, pale above the horizon, brown ground, and a sun at azimuth 45°, elevation 50° that is ten times as wide as
    /// the real one and gives about three times the light of the sky.
    #[must_use]
    pub fn sky() -> Self {
        let sun = direction([45.0_f64.to_radians(), 50.0_f64.to_radians()]);
        let mix = |a: [f64; 3], b: [f64; 3], part: f64| [0, 1, 2].map(|channel| a[channel] + part * (b[channel] - a[channel]));
        Self::procedural(|direction| {
            let sky = mix([0.75, 0.8, 0.85], [0.12, 0.25, 0.6], direction.y.max(0.0).sqrt());
            let scene = mix([0.16, 0.13, 0.1], sky, smooth_step(-0.02, 0.02, direction.y));
            let disc = 750.0 * smooth_step(3.0_f64.to_radians().cos(), 2.0_f64.to_radians().cos(), direction.dot(sun));
            [0, 1, 2].map(|channel| scene[channel] + disc * [1.0, 0.95, 0.85][channel])
        })
    }

    /// 512 x 256 texels of `radiance(direction)`, which is from 0 to [`Self::MAX_RADIANCE`].
    fn procedural(radiance: impl Fn(DVec3) -> [f64; 3]) -> Self {
        let (width, height) = (512, 256);
        #[expect(clippy::cast_possible_truncation, reason = "rounds")]
        let texel = |column, row| radiance(texel_direction([width, height], [column, row])).map(|value| value as f32);
        Self { radiance: Map::from_fn(width, height, texel) }
    }

    /// The values.
    #[must_use]
    pub fn map(&self) -> &Map<[f32; 3]> {
        &self.radiance
    }

    /// Unit vector towards the middle of a texel.
    #[must_use]
    pub fn direction(&self, texel: [usize; 2]) -> DVec3 {
        texel_direction([self.radiance.width(), self.radiance.height()], texel)
    }

    /// The value from a direction of any length: bilinear between the middles of texels, around the azimuth; beyond the uppermost and
    /// lowermost middles that of the row.
    #[must_use]
    pub fn radiance(&self, direction: DVec3) -> [f64; 3] {
        let (width, height) = (self.radiance.width(), self.radiance.height());
        let azimuth = direction.x.atan2(direction.z);
        let elevation = direction.y.atan2(direction.x.hypot(direction.z));
        let x = (0.5 - azimuth / TAU) * width as f64 - 0.5;
        let y = ((0.5 - elevation / PI) * height as f64 - 0.5).clamp(0.0, (height - 1) as f64);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "columns and rows")]
        let (column, row) = (x.floor().rem_euclid(width as f64) as usize % width, y as usize);
        let (right, below) = ((column + 1) % width, (row + 1).min(height - 1));
        let (across, down) = (x - x.floor(), y - y.floor());
        let corners = [
            ((column, row), (1.0 - across) * (1.0 - down)),
            ((right, row), across * (1.0 - down)),
            ((column, below), (1.0 - across) * down),
            ((right, below), across * down),
        ];
        [0, 1, 2].map(|channel| corners.iter().map(|&(texel, weight)| weight * f64::from(self.radiance[texel][channel])).sum())
    }
}

/// Unit vector towards (azimuth, elevation), radians.
fn direction([azimuth, elevation]: [f64; 2]) -> DVec3 {
    dvec3(azimuth.sin() * elevation.cos(), elevation.sin(), azimuth.cos() * elevation.cos())
}

fn texel_direction([width, height]: [usize; 2], [column, row]: [usize; 2]) -> DVec3 {
    let part = |index: usize, count: usize| (index as f64 + 0.5) / count as f64;
    direction([PI - TAU * part(column, width), FRAC_PI_2 - PI * part(row, height)])
}

/// How much of a soft box is seen, 0 to 1: a rectangle about (azimuth, elevation) in degrees, with a smooth edge.
fn soft_box([azimuth, elevation]: [f64; 2], half: [f64; 2], seen: DVec3) -> f64 {
    const EDGE: f64 = 0.06;
    let middle = direction([azimuth.to_radians(), elevation.to_radians()]);
    let depth = middle.dot(seen);
    if depth <= 0.0 {
        return 0.0;
    }
    let right = DVec3::Y.cross(middle).normalize();
    let place = [right.dot(seen) / depth, middle.cross(right).dot(seen) / depth];
    [0, 1].map(|axis| smooth_step(half[axis] + EDGE, half[axis] - EDGE, place[axis].abs())).iter().product()
}

/// 0 up to `low`, 1 from `high`, a smooth cubic between; `low` may be the larger.
fn smooth_step(low: f64, high: f64, value: f64) -> f64 {
    let part = ((value - low) / (high - low)).clamp(0.0, 1.0);
    part * part * (3.0 - 2.0 * part)
}
