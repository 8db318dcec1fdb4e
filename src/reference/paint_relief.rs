//! Twin of `paint_relief`, from [`Layer::rise`].

use crate::{data::Map, model::Layer};

/// `ground` (texel widths) raised by `layer` of the thickness `drawn`.
#[must_use]
pub fn paint_relief(ground: &Map<f64>, drawn: &Map<f64>, layer: &Layer) -> Map<f64> {
    Map::from_fn(ground.width(), ground.height(), |column, row| ground[(column, row)] + layer.rise(drawn[(column, row)]))
}
