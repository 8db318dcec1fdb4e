//! Twin of `average`.

use crate::data::Map;

/// The mean of `pictures`, pixel by pixel.
#[must_use]
#[expect(clippy::cast_precision_loss, reason = "a few pictures")]
pub fn average(pictures: &[Map<[f64; 4]>]) -> Map<[f64; 4]> {
    Map::from_fn(pictures[0].width(), pictures[0].height(), |column, row| {
        std::array::from_fn(|channel| pictures.iter().map(|picture| picture[(column, row)][channel]).sum::<f64>() / pictures.len() as f64)
    })
}
