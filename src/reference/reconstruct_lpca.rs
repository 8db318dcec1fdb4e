//! Twin of `reconstruct_lpca` and of the evaluation in `kernels/common/lpca.wgsl`: texels are decompressed first, sample by sample.

use crate::{
    data::{BtfError, Direction, DirectionMesh, Lpca, Map, nearest_samples},
    model::{Boundary, TexelSamples},
};

/// A compressed BTF and what interpolates between its samples.
#[derive(Debug, Clone)]
pub struct CompressedBtf<'a> {
    lpca: &'a Lpca,
    views: DirectionMesh,
    lights: DirectionMesh,
    /// Of the measured lights.
    cosines: Vec<f64>,
    /// `[view][light]`
    samples: Map<usize>,
    boundary: Boundary,
}

impl<'a> CompressedBtf<'a> {
    /// Of a local PCA whose pairs refer to `views` and `lights`.
    ///
    /// # Errors
    /// [`BtfError`] if there is no pair, or one refers to no direction.
    pub fn new(lpca: &'a Lpca, views: &[Direction], lights: &[Direction], boundary: Boundary) -> Result<Self, BtfError> {
        let samples = nearest_samples(&lpca.pairs, views, lights)?;
        let cosines = lights.iter().map(|light| light.vector().z).collect();
        Ok(Self { lpca, views: DirectionMesh::new(views), lights: DirectionMesh::new(lights), cosines, samples, boundary })
    }

    /// L of a texel in a sample: term_0 + Σ w_c term_c (Müller, Meseth, Klein 2003).
    #[must_use]
    pub fn decompressed(&self, sample: usize, texel: (usize, usize)) -> [f64; 3] {
        let Lpca { clusters, components, cluster, weights, terms, .. } = self.lpca;
        let of_texel = &weights[(texel.1 * cluster.width() + texel.0) * components..][..*components];
        let first = (sample * clusters + cluster[texel] as usize) * (1 + components);
        std::array::from_fn(|channel| {
            let term = |index: usize| terms[3 * (first + index) + channel].to_f64();
            term(0) + of_texel.iter().enumerate().map(|(component, weight)| weight.to_f64() * term(1 + component)).sum::<f64>()
        })
    }

    /// Radiance that leaves place (column, row) of the base plane, no less than 0.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "places are on the plane or near it")]
    #[expect(clippy::cast_precision_loss, reason = "columns and rows")]
    pub fn radiance(&self, place: [f64; 2], texel_samples: TexelSamples, view: Direction, light: Direction) -> [f64; 3] {
        if view.vector().z < 0.0 || light.vector().z < 0.0 {
            return [0.0; 3];
        }
        let [column, row] = place.map(|at| at.round() as isize);
        let wrap = |index: isize, count: usize| self.boundary.wrap(index, count);
        let (views, lights) = (self.views.weights(view), self.lights.weights(light));
        let (mut sum, mut total) = ([0.0; 3], 0.0);
        for (x, y) in (-3..=3).flat_map(|y| (-3..=3).map(move |x| (column + x, row + y))) {
            let weight = texel_weight(texel_samples, [place[0] - x as f64, place[1] - y as f64]);
            if weight <= 0.0 {
                continue;
            }
            total += weight;
            let texel = (wrap(x, self.lpca.cluster.width()), wrap(y, self.lpca.cluster.height()));
            for (from, of_view) in views {
                for (toward, of_light) in lights {
                    let own = self.decompressed(self.samples[(toward, from)], texel);
                    (0..3).for_each(|channel| sum[channel] += weight * of_view * of_light * own[channel]);
                }
            }
        }
        // The lowest measured lights' radiance falls on to the horizon with the irradiance.
        let cosine = lights.map(|(toward, weight)| weight * self.cosines[toward]).iter().sum::<f64>();
        let left = if self.lights.is_below(light) { (light.vector().z / cosine.max(1e-6)).min(1.0) } else { 1.0 };
        sum.map(|sum| (left * sum / total).max(0.0))
    }
}

/// Weight of a texel at an offset from a place, before they are made to sum to 1.
fn texel_weight(texel_samples: TexelSamples, [x, y]: [f64; 2]) -> f64 {
    let spline = |width: u32| b_spline(width, x) * b_spline(width, y);
    match texel_samples {
        TexelSamples::One => spline(1),
        TexelSamples::Four => spline(2),
        TexelSamples::Five if x.abs() > 0.5 && y.abs() > 0.5 => 0.0,
        TexelSamples::Five | TexelSamples::Nine => spline(3),
        TexelSamples::TwentyFive => spline(5),
    }
}

/// The centred B-spline of `width` unit boxes, by the recursion of de Boor (1972) and Cox (1972).
fn b_spline(width: u32, x: f64) -> f64 {
    // On [0, width); half-open, so that boxes do not overlap.
    fn from_left(width: u32, t: f64) -> f64 {
        if width == 1 {
            return if (0.0..1.0).contains(&t) { 1.0 } else { 0.0 };
        }
        let degree = f64::from(width - 1);
        (t * from_left(width - 1, t) + (f64::from(width) - t) * from_left(width - 1, t - 1.0)) / degree
    }
    from_left(width, x + 0.5 * f64::from(width))
}

/// π·L_o/E per pixel, one pixel a texel of the base plane.
#[must_use]
#[expect(clippy::cast_precision_loss, reason = "columns and rows of a picture")]
pub fn reconstruct_lpca(btf: &CompressedBtf<'_>, texel_samples: TexelSamples, view: Direction, light: Direction) -> Map<[f64; 3]> {
    let cluster = &btf.lpca.cluster;
    Map::from_fn(cluster.width(), cluster.height(), |column, row| btf.radiance([column as f64, row as f64], texel_samples, view, light))
}
