//! Rays against a height field, exactly: between grid lines a ray runs over one bilinear patch, where the height below it is a
//! parabola in the ray's own height, and so are the crossings and the extremes.

use glam::DVec3;

use crate::{data::Map, model::Boundary};

/// Heights at texel centres, bilinear between, continued by the boundary rule. Places are (column, row).
pub(super) struct HeightField<'a> {
    heights: &'a Map<f64>,
    boundary: Boundary,
    lowest: f64,
    highest: f64,
}

/// A stretch of a ray over one patch: from z = `low` to z = `high`, height minus z is c₀ + c₁(z − low) + c₂(z − low)².
struct Stretch {
    low: f64,
    high: f64,
    coefficients: [f64; 3],
}

/// (Column, row) gained with one texel width of height.
fn run(direction: DVec3) -> [f64; 2] {
    [direction.x / direction.z, -direction.y / direction.z]
}

impl<'a> HeightField<'a> {
    pub(super) fn new(heights: &'a Map<f64>, boundary: Boundary) -> Self {
        let lowest = heights.values().iter().copied().fold(f64::INFINITY, f64::min);
        let highest = heights.values().iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Self { heights, boundary, lowest, highest }
    }

    pub(super) fn at(&self, place: [f64; 2]) -> f64 {
        self.corners(place).into_iter().map(|(texel, weight)| weight * self.heights[texel]).sum()
    }

    /// The four texels around a place with their bilinear weights.
    pub(super) fn corners(&self, [column, row]: [f64; 2]) -> [((usize, usize), f64); 4] {
        let (left, upper) = (column.floor(), row.floor());
        let (right_share, lower_share) = (column - left, row - upper);
        [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(right, lower)| {
            #[expect(clippy::cast_possible_truncation, reason = "whole numbers near the plane")]
            let (x, y) = (left as isize + right, upper as isize + lower);
            let texel = (self.boundary.wrap(x, self.heights.width()), self.boundary.wrap(y, self.heights.height()));
            let weight_x = if right == 1 { right_share } else { 1.0 - right_share };
            let weight_y = if lower == 1 { lower_share } else { 1.0 - lower_share };
            (texel, weight_x * weight_y)
        })
    }

    /// The ray place(z) = start + z·run cut at the grid lines, upwards.
    fn stretches(&self, start: [f64; 2], run: [f64; 2], low: f64, high: f64) -> impl DoubleEndedIterator<Item = Stretch> {
        let mut cuts = vec![low, high];
        for axis in 0..2 {
            let ends = [start[axis] + low * run[axis], start[axis] + high * run[axis]];
            let mut line = ends[0].min(ends[1]).ceil();
            while line < ends[0].max(ends[1]) {
                cuts.push(((line - start[axis]) / run[axis]).clamp(low, high));
                line += 1.0;
            }
        }
        cuts.sort_by(f64::total_cmp);
        let place = move |z: f64| [start[0] + z * run[0], start[1] + z * run[1]];
        let pairs: Vec<_> = cuts.windows(2).map(|pair| (pair[0], pair[1])).collect();
        pairs.into_iter().map(move |(low, high)| {
            // Height minus z at both ends and the middle, all on the middle's patch, gives the parabola.
            let length = high - low;
            let middle = 0.5 * (low + high);
            let gap = |z: f64| self.at_on_patch(place(middle), place(z)) - z;
            let (a, b, c) = (gap(low), gap(middle), gap(high));
            let coefficients = if length > 0.0 {
                [a, (4.0 * b - 3.0 * a - c) / length, 2.0 * (a - 2.0 * b + c) / (length * length)]
            } else {
                [a, 0.0, 0.0]
            };
            Stretch { low, high, coefficients }
        })
    }

    /// Height at `place` on the bilinear patch that contains `inside`.
    fn at_on_patch(&self, inside: [f64; 2], place: [f64; 2]) -> f64 {
        let corner = inside.map(f64::floor);
        let [upper_left, upper_right, lower_left, lower_right] =
            self.corners(corner.map(|x| x + 0.5)).map(|(texel, _)| self.heights[texel]);
        let (x, y) = (place[0] - corner[0], place[1] - corner[1]);
        upper_left
            + (upper_right - upper_left) * x
            + (lower_left - upper_left) * y
            + (upper_left - upper_right - lower_left + lower_right) * x * y
    }

    /// Where the ray from above along −`view` that crosses z = 0 at `base` first meets the field: place and height.
    pub(super) fn first_hit(&self, base: [f64; 2], view: DVec3) -> ([f64; 2], f64) {
        let run = run(view);
        let z =
            self.stretches(base, run, self.lowest, self.highest).rev().find_map(|stretch| stretch.highest_zero()).unwrap_or(self.lowest);
        let place = [base[0] + z * run[0], base[1] + z * run[1]];
        (place, self.at(place))
    }

    /// Share of a light of angular width atan(`penumbra`) that a point of the field sees: 1 less the largest
    /// excess/(path length·penumbra) (Tatarchuk 2006), blockers nearer than half a texel left to the surface's own shading.
    pub(super) fn seen_share(&self, place: [f64; 2], height: f64, light: DVec3, penumbra: f64) -> f64 {
        let run = run(light);
        let start = [place[0] - height * run[0], place[1] - height * run[1]];
        let from = height + 0.5 / run[0].hypot(run[1]);
        if from >= self.highest {
            return 1.0;
        }
        let cover = self
            .stretches(start, run, from, self.highest)
            .map(|stretch| stretch.greatest_ratio(height) * light.z / penumbra)
            .fold(0.0, f64::max);
        1.0 - cover.min(1.0)
    }

    /// Whether the field stands above the ray from a point of it to the light, anywhere.
    pub(super) fn is_shadowed(&self, place: [f64; 2], height: f64, light: DVec3) -> bool {
        // What a crossing's rounding leaves of the point's own height.
        const ABOVE: f64 = 1e-9;
        let run = run(light);
        let start = [place[0] - height * run[0], place[1] - height * run[1]];
        height + ABOVE < self.highest
            && self.stretches(start, run, height + ABOVE, self.highest).any(|stretch| stretch.greatest_gap() > ABOVE)
    }
}

impl Stretch {
    fn gap(&self, z: f64) -> f64 {
        let [c0, c1, c2] = self.coefficients;
        let step = z - self.low;
        c0 + step * (c1 + step * c2)
    }

    /// Largest z at which height and ray meet.
    fn highest_zero(&self) -> Option<f64> {
        if self.gap(self.high) >= 0.0 {
            return Some(self.high);
        }
        let [c0, c1, c2] = self.coefficients;
        let mut zeros = if c2.abs() < 1e-12 {
            vec![-c0 / c1]
        } else {
            let root = (c1 * c1 - 4.0 * c2 * c0).sqrt();
            vec![(-c1 - root) / (2.0 * c2), (-c1 + root) / (2.0 * c2)]
        };
        zeros.sort_by(f64::total_cmp);
        zeros.into_iter().rev().find(|step| (0.0..=self.high - self.low).contains(step)).map(|step| self.low + step)
    }

    /// Largest of height minus z.
    fn greatest_gap(&self) -> f64 {
        let [_, c1, c2] = self.coefficients;
        let summit = self.low - 0.5 * c1 / c2;
        let ends = self.gap(self.low).max(self.gap(self.high));
        if (self.low..=self.high).contains(&summit) { ends.max(self.gap(summit)) } else { ends }
    }

    /// Largest of (height minus z)/(z − `from`), `from` below the stretch.
    fn greatest_ratio(&self, from: f64) -> f64 {
        // With w = z − from, gap = k₀ + k₁w + k₂w² and gap/w is stationary at w² = k₀/k₂.
        let [c0, c1, c2] = self.coefficients;
        let lead = self.low - from;
        let k0 = c0 - c1 * lead + c2 * lead * lead;
        let stationary = from + (k0 / c2).sqrt();
        let ratio = |z: f64| self.gap(z) / (z - from);
        let ends = ratio(self.low).max(ratio(self.high));
        if (self.low..=self.high).contains(&stationary) { ends.max(ratio(stationary)) } else { ends }
    }
}
