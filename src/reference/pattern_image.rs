//! Twin of `pattern_image`: every pixel of every repetition weighed, areas from a table of sums, in f64.

use super::pattern::Plane;
use crate::{data::Map, model::Placement};

/// Thickness that `image` draws at `placement` on a plane of `width` x `height` texels that repeats.
#[must_use]
#[expect(clippy::cast_precision_loss, reason = "sizes far below 2^53")]
pub fn pattern_image(image: &Map<f64>, placement: Placement, width: u32, height: u32) -> Map<f64> {
    let plane = Plane { size: [width, height], placement };
    let edges = plane.edges();
    let fit = (edges[0] / image.width() as f64).min(edges[1] / image.height() as f64);
    // Lengths of the image's edges, and a texel's, in cell coordinates.
    let extent = [image.width(), image.height()].map(|pixels| pixels as f64 * fit * placement.size);
    let cell = placement.cell([width, height]);
    let texel = 1.0 / cell[0].min(cell[1]);
    let image = reduced(image.clone(), extent.map(|edge| edge / texel));
    let pixels = [image.width(), image.height()];
    let pixel = [0, 1].map(|axis| extent[axis] / pixels[axis] as f64);
    let reach = pixel.map(|pixel| (texel / pixel).max(1.0));
    let quarters = placement.rotation / std::f64::consts::FRAC_PI_2;
    let turned = (quarters - quarters.round()).abs() < 1e-9;
    let side = usize::from(quarters.round().rem_euclid(2.0) == 1.0);
    let closed = [0, 1].map(|axis| turned && (extent[axis] / edges[axis ^ side] - 1.0).abs() < 1e-9);
    // Edges are at least 1 long: more repetitions to either side than may reach a place, and no more than the stage looks at.
    #[expect(clippy::cast_possible_truncation, reason = "at most 16")]
    let most = (extent[0].hypot(extent[1]) + 3.0 * texel + 3.0 * pixel[0].max(pixel[1])).ceil().min(16.0) as i32;
    Map::from_fn(width as usize, height as usize, |column, row| {
        let place = plane.place(column, row);
        let nearest = [0, 1].map(|axis| (place[axis] + 0.5 * edges[axis]).rem_euclid(edges[axis]) - 0.5 * edges[axis]);
        let mut thickest = 0.0_f64;
        for repetition in 0..(2 * most + 1).pow(2) {
            let which = [repetition % (2 * most + 1) - most, repetition / (2 * most + 1) - most];
            // Along an axis that closes, all repetitions are one.
            if [0, 1].into_iter().any(|axis| closed[axis ^ side] && which[axis] != 0) {
                continue;
            }
            let apart = [0, 1].map(|axis| nearest[axis] - f64::from(which[axis]) * edges[axis]);
            let angle = apart[1].atan2(apart[0]) - placement.rotation;
            let radius = apart[0].hypot(apart[1]);
            let own = [radius * angle.cos(), -radius * angle.sin()];
            let at = [0, 1].map(|axis| own[axis] / pixel[axis] + 0.5 * (pixels[axis] as f64 - 1.0));
            if (0..2).any(|axis| (own[axis] / pixel[axis]).abs() > 0.5 * pixels[axis] as f64 + 2.0 * reach[axis]) {
                continue;
            }
            let weights = [0, 1].map(|axis| weights(at[axis], reach[axis], pixels[axis], closed[axis]));
            let sum: f64 = weights[1]
                .iter()
                .map(|(row, down)| down * weights[0].iter().map(|(column, along)| along * image[(*column, *row)]).sum::<f64>())
                .sum();
            thickest = thickest.max(sum);
        }
        thickest
    })
}

/// The pixels under a tent of `reach` around `middle` and their shares of it; the rest of the tent lies outside.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "pixel indices; tents reach a few pixels")]
fn weights(middle: f64, reach: f64, pixels: usize, closed: bool) -> Vec<(usize, f64)> {
    let [first, last] = [(middle - reach).floor() as i64, (middle + reach).ceil() as i64];
    let weight = |pixel: i64| (1.0 - (f64::from(pixel as i32) - middle).abs() / reach).max(0.0);
    let whole: f64 = (first..=last).map(weight).sum();
    let inside = |pixel: i64| {
        let wrapped = pixel.rem_euclid(pixels as i64);
        (closed || wrapped == pixel).then_some((wrapped as usize, weight(pixel) / whole))
    };
    (first..=last).filter_map(inside).collect()
}

/// The image with at most eight pixels a texel, by the same steps as the stage.
#[expect(clippy::cast_precision_loss, clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "sizes far below 2^53")]
fn reduced(image: Map<f64>, extent_texels: [f64; 2]) -> Map<f64> {
    let size = [image.width(), image.height()];
    let next = [0, 1].map(|axis| {
        let a_texel = size[axis] as f64 / extent_texels[axis];
        if a_texel > 8.0 + 1e-6 { size[axis].div_ceil((a_texel / 4.0 + 1e-6).clamp(2.0, 8.0).floor() as usize) } else { size[axis] }
    });
    if next == size {
        return image;
    }
    // The sum of all pixels above and to the left of a place, linear inside a pixel.
    let mut sums = Map::from_fn(size[0] + 1, size[1] + 1, |_, _| 0.0);
    for row in 0..size[1] {
        for column in 0..size[0] {
            let before = sums[(column + 1, row)] + sums[(column, row + 1)] - sums[(column, row)];
            sums[(column + 1, row + 1)] = before + image[(column, row)];
        }
    }
    let until = |x: f64, y: f64| {
        let [column, row] = [(x, size[0]), (y, size[1])].map(|(place, pixels)| (place.floor() as usize).min(pixels - 1));
        let (along, down) = (x - column as f64, y - row as f64);
        let upper = (1.0 - along) * sums[(column, row)] + along * sums[(column + 1, row)];
        let lower = (1.0 - along) * sums[(column, row + 1)] + along * sums[(column + 1, row + 1)];
        (1.0 - down) * upper + down * lower
    };
    let covered = [0, 1].map(|axis| size[axis] as f64 / next[axis] as f64);
    let smaller = Map::from_fn(next[0], next[1], |column, row| {
        let [left, top] = [column as f64 * covered[0], row as f64 * covered[1]];
        let [right, bottom] = [left + covered[0], top + covered[1]];
        (until(right, bottom) - until(left, bottom) - until(right, top) + until(left, top)) / (covered[0] * covered[1])
    });
    reduced(smaller, extent_texels)
}
