//! The description of a BTF: its texel plane, its (view, light) pairs and its conventions. The texels themselves come
//! from a reader in [`io`](crate::io).

use std::collections::BTreeSet;

use super::{
    Direction, Encoding,
    grid::{Ring, UBO81, UBO151},
};

/// One sample: which view and which light, as indices into [`Btf::views`] and [`Btf::lights`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Pair {
    /// Index of the view.
    pub view: usize,
    /// Index of the light.
    pub light: usize,
}

/// What keeps a list of directions and pairs from being a BTF.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BtfError {
    /// No pairs at all.
    #[error("a BTF needs at least one (view, light) pair, but there is none; add one")]
    Empty,
    /// No texels.
    #[error("a BTF needs at least one texel, but its images are {width} x {height}")]
    NoTexels {
        /// Columns.
        width: usize,
        /// Rows.
        height: usize,
    },
    /// A pair refers to a direction that is not listed.
    #[error("pair {pair:?} refers to a direction outside the {views} views and {lights} lights")]
    PairOutOfRange {
        /// The pair.
        pair: Pair,
        /// Number of views.
        views: usize,
        /// Number of lights.
        lights: usize,
    },
    /// A direction from below the surface.
    #[error("direction {direction} is not above the surface; θ must be from 0 to below 90 degrees")]
    BelowHorizon {
        /// The direction.
        direction: Direction,
    },
}

/// A material under a list of (view, light) pairs over one texel plane.
#[derive(Debug, Clone, PartialEq)]
pub struct Btf {
    name: String,
    width: usize,
    height: usize,
    views: Vec<Direction>,
    lights: Vec<Direction>,
    pairs: Vec<Pair>,
    encoding: Encoding,
}

impl Btf {
    /// A BTF of `width` x `height` texels. Samples are numbered as in `pairs`.
    ///
    /// # Errors
    /// [`BtfError`] if anything is empty, a pair is out of range or a direction below the horizon.
    pub fn new(
        name: String, [width, height]: [usize; 2], views: Vec<Direction>, lights: Vec<Direction>, pairs: Vec<Pair>, encoding: Encoding,
    ) -> Result<Self, BtfError> {
        if pairs.is_empty() {
            return Err(BtfError::Empty);
        }
        if width == 0 || height == 0 {
            return Err(BtfError::NoTexels { width, height });
        }
        if let Some(&pair) = pairs.iter().find(|pair| pair.view >= views.len() || pair.light >= lights.len()) {
            return Err(BtfError::PairOutOfRange { pair, views: views.len(), lights: lights.len() });
        }
        let above = |direction: &&Direction| !(0.0..std::f64::consts::FRAC_PI_2).contains(&direction.theta);
        if let Some(&direction) = views.iter().chain(&lights).find(above) {
            return Err(BtfError::BelowHorizon { direction });
        }
        Ok(Self { name, width, height, views, lights, pairs, encoding })
    }

    /// Name of the material.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Columns and rows of the texel plane.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// Number of texels.
    #[must_use]
    pub fn texels(&self) -> usize {
        self.width * self.height
    }

    /// The distinct views.
    #[must_use]
    pub fn views(&self) -> &[Direction] {
        &self.views
    }

    /// The distinct lights.
    #[must_use]
    pub fn lights(&self) -> &[Direction] {
        &self.lights
    }

    /// The samples.
    #[must_use]
    pub fn pairs(&self) -> &[Pair] {
        &self.pairs
    }

    /// (view, light) of sample `sample`.
    #[must_use]
    pub fn directions(&self, sample: usize) -> (Direction, Direction) {
        let Pair { view, light } = self.pairs[sample];
        (self.views[view], self.lights[light])
    }

    /// How the stored values become radiance.
    #[must_use]
    pub fn encoding(&self) -> &Encoding {
        &self.encoding
    }

    /// Whether every view was photographed under every light, in view-major order.
    #[must_use]
    pub fn is_product(&self) -> bool {
        let lights = self.lights.len();
        self.pairs.len() == self.views.len() * lights
            && self.pairs.iter().enumerate().all(|(index, pair)| pair.view == index / lights && pair.light == index % lights)
    }

    /// How many pairs of a view and a light have no sample.
    #[must_use]
    pub fn missing(&self) -> usize {
        self.views.len() * self.lights.len() - self.distinct_pairs().len()
    }

    /// The pairs of a view and a light that have no sample, view-major.
    pub fn missing_pairs(&self) -> impl Iterator<Item = Pair> {
        let mut there = self.distinct_pairs().into_iter().peekable();
        let all = (0..self.views.len()).flat_map(|view| (0..self.lights.len()).map(move |light| Pair { view, light }));
        all.filter(move |pair| there.next_if_eq(pair).is_none())
    }

    fn distinct_pairs(&self) -> BTreeSet<Pair> {
        self.pairs.iter().copied().collect()
    }

    /// The samples of the view nearest the zenith: those that photometric stereo takes (Rushmeier et al. 1997).
    #[must_use]
    pub fn zenith_samples(&self) -> Vec<usize> {
        let theta = |sample: &usize| self.views[self.pairs[*sample].view].theta;
        let nearest = (0..self.pairs.len()).map(|sample| theta(&sample)).fold(f64::INFINITY, f64::min);
        // Views written in decimal degrees differ from each other by far more than this.
        (0..self.pairs.len()).filter(|sample| theta(sample) - nearest < 1e-6).collect()
    }

    /// Name of the direction grid if it is a known one.
    #[must_use]
    pub fn grid(&self) -> Option<&'static str> {
        let counts = |directions: &[Direction]| {
            let mut rings: Vec<(i64, usize)> = Vec::new();
            for direction in directions {
                #[expect(clippy::cast_possible_truncation, reason = "tenths of a degree from 0 to 900")]
                let tenths = (direction.theta.to_degrees() * 10.0).round() as i64;
                match rings.iter_mut().find(|(ring, _)| *ring == tenths) {
                    Some((_, count)) => *count += 1,
                    None => rings.push((tenths, 1)),
                }
            }
            rings.sort_unstable();
            rings
        };
        let (views, lights) = (counts(&self.views), counts(&self.lights));
        let known = |grid: &[Ring]| {
            let is = |(&(tenths, count), ring): (&(i64, usize), &Ring)| tenths as f64 == 10.0 * ring.theta && count == ring.count;
            [&views, &lights].into_iter().all(|found| found.len() == grid.len() && found.iter().zip(grid).all(is))
        };
        [("UBO81", UBO81), ("UBO151", UBO151)].into_iter().find(|(_, grid)| known(grid)).map(|(name, _)| name)
    }
}
