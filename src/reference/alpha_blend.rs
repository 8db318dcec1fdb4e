//! Twin of `alpha_blend`: what each layer shows of itself from above, from the top down.

use super::PaintedTexel;
use crate::{data::Map, model::Layer};

/// `ground` under `layers`, from the bottom up, each with its drawn thickness.
#[must_use]
pub fn alpha_blend(ground: &Map<PaintedTexel>, layers: &[(&Layer, &Map<f64>)]) -> Map<PaintedTexel> {
    Map::from_fn(ground.width(), ground.height(), |column, row| {
        let below = ground[(column, row)];
        let (mut bare, mut coverage, mut shown) = (1.0, 0.0, [0.0; 3]);
        let of_layers = layers.iter().rev().map(|(layer, drawn)| (layer.colour(), drawn[(column, row)]));
        for (colour, alpha) in of_layers.chain([(below.reflectance, below.coverage)]) {
            (0..3).for_each(|channel| shown[channel] += bare * alpha * colour[channel]);
            coverage += bare * alpha;
            bare *= 1.0 - alpha;
        }
        let reflectance = if coverage > 0.0 { shown.map(|channel| channel / coverage) } else { below.reflectance };
        PaintedTexel { reflectance, coverage, ..below }
    })
}
