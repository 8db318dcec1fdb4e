//! Twin of `minify`: a level as a product of matrices, of which each row says what part of the finer texels a coarser one covers.

use crate::data::Map;

/// What paint looks like on one level.
#[derive(Debug, Clone)]
pub struct PaintLevel {
    /// ρ_d and coverage.
    pub painted: Map<[f64; 4]>,
    /// F₀ and α.
    pub coat: Map<[f64; 2]>,
    /// Unit normal, and what is added to α².
    pub normals: Map<[f64; 4]>,
}

/// The next coarser level, of half the columns and rows, of an odd number the smaller half.
#[must_use]
pub fn minify(fine: &PaintLevel) -> PaintLevel {
    let (columns, rows) = (shares(fine.painted.width()), shares(fine.painted.height()));
    let (width, height) = (columns.len(), rows.len());
    let mean = |of: &dyn Fn((usize, usize)) -> f64| {
        Map::from_fn(width, height, |column, row| {
            let finer = rows[row]
                .iter()
                .enumerate()
                .flat_map(|(y, down)| columns[column].iter().enumerate().map(move |(x, across)| (x, y, down * across)));
            finer.filter(|&(.., share)| share > 0.0).map(|(x, y, share)| share * of((x, y))).sum::<f64>()
        })
    };
    let coverage = mean(&|at| fine.painted[at][3]);
    let of_paint = |of: &dyn Fn((usize, usize)) -> f64| mean(&|at| fine.painted[at][3] * of(at));
    let pigment = [0, 1, 2].map(|channel| of_paint(&|at| fine.painted[at][channel]));
    let f0 = of_paint(&|at| fine.coat[at][0]);
    let alpha2 = of_paint(&|at| fine.coat[at][1].powi(2));
    // |m| of s = 2(1 - |m|)/|m|.
    let shortened = |at: (usize, usize), axis: usize| fine.normals[at][axis] * 2.0 / (2.0 + fine.normals[at][3]);
    let painted_normal = [0, 1, 2].map(|axis| of_paint(&|at| shortened(at, axis)));
    let normal = [0, 1, 2].map(|axis| mean(&|at| shortened(at, axis)));
    PaintLevel {
        painted: Map::from_fn(width, height, |column, row| {
            let at = (column, row);
            let covered = coverage[at];
            if covered > 0.0 { [pigment[0][at] / covered, pigment[1][at] / covered, pigment[2][at] / covered, covered] } else { [0.0; 4] }
        }),
        coat: Map::from_fn(width, height, |column, row| {
            let at = (column, row);
            let covered = coverage[at];
            if covered > 0.0 { [f0[at] / covered, (alpha2[at] / covered).sqrt()] } else { [0.0; 2] }
        }),
        normals: Map::from_fn(width, height, |column, row| {
            let at = (column, row);
            let sums = if coverage[at] > 0.0 { &painted_normal } else { &normal };
            let share = if coverage[at] > 0.0 { coverage[at] } else { 1.0 };
            let mean = [0, 1, 2].map(|axis| sums[axis][at] / share);
            let length = mean.iter().map(|x| x * x).sum::<f64>().sqrt();
            [mean[0] / length, mean[1] / length, mean[2] / length, (2.0 / length - 2.0).max(0.0)]
        }),
    }
}

/// `[coarser][finer]` shares of the finer texels of a side that a coarser one averages.
#[expect(clippy::cast_precision_loss, reason = "texels along a side")]
fn shares(finer: usize) -> Vec<Vec<f64>> {
    let coarser = (finer / 2).max(1);
    let ratio = finer as f64 / coarser as f64;
    let overlap = |index: usize, texel: usize| {
        let [low, high] = [index, index + 1].map(|end| end as f64 * ratio);
        (high.min(texel as f64 + 1.0) - low.max(texel as f64)).max(0.0) / ratio
    };
    (0..coarser).map(|index| (0..finer).map(|texel| overlap(index, texel)).collect()).collect()
}
