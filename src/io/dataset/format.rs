//! The form of a dataset on disk: its arrays, their chunks and attributes.

use serde_json::{Map, Value, json};

use crate::data::{Btf, Direction};

/// Name of the form, in the group's attributes.
pub const DATASET_FORMAT: &str = "overpaint dataset";

/// Version of the form, in the group's attributes.
pub(super) const VERSION: u64 = 1;

/// Name of the array of radiance.
pub(super) const RADIANCE: &str = "radiance";
/// Which light a view's slot holds, of a dataset that is no product of views and lights.
pub(super) const SLOT_LIGHT: &str = "slot_light";
/// What stands in [`SLOT_LIGHT`] where a view has fewer samples than others.
pub(super) const NO_LIGHT: i32 = -1;
/// Names of the arrays of angles in degrees, and along what they run.
pub(super) const ANGLES: [(&str, &str); 4] =
    [("view_theta", "view"), ("view_phi", "view"), ("light_theta", "light"), ("light_phi", "light")];

/// Bytes of a tile with all its samples at most, so that a few fit the host and one fits most adapters.
const MAX_TILE_BYTES: usize = 1 << 28;
const MAX_SIDE: usize = 128;
const MIN_SIDE: usize = 8;

/// Columns and rows of a chunk: the largest power of two whose tile with all samples keeps to [`MAX_TILE_BYTES`].
pub(super) fn side(samples: usize) -> usize {
    let mut side = MAX_SIDE;
    while side > MIN_SIDE && side * side * samples * 6 > MAX_TILE_BYTES {
        side /= 2;
    }
    side
}

/// Samples of the view that has most.
pub(super) fn slots(btf: &Btf) -> usize {
    let mut counts = vec![0; btf.views().len()];
    btf.pairs().iter().for_each(|pair| counts[pair.view] += 1);
    counts.into_iter().max().unwrap_or(0)
}

/// (view, slot) of each sample: a view's samples take its slots in order.
pub(super) fn places(btf: &Btf) -> Vec<(usize, usize)> {
    let mut taken = vec![0; btf.views().len()];
    let place = |view: usize| {
        taken[view] += 1;
        (view, taken[view] - 1)
    };
    btf.pairs().iter().map(|pair| pair.view).map(place).collect()
}

/// Names of the dimensions of [`RADIANCE`].
pub(super) fn dimensions(btf: &Btf) -> [&'static str; 5] {
    ["view", if btf.is_product() { "light" } else { "slot" }, "channel", "row", "column"]
}

/// Attributes of [`RADIANCE`].
pub(super) fn radiance_attributes() -> Map<String, Value> {
    Map::from_iter([
        ("unit".to_owned(), json!("pi L / E")),
        ("description".to_owned(), json!("radiance in reflectance units: a white Lambertian surface lit from theta has cos theta")),
        ("components".to_owned(), json!(["R", "G", "B"])),
        // By this, xarray takes the angles for coordinates.
        ("coordinates".to_owned(), json!(ANGLES.map(|(name, _)| name).join(" "))),
    ])
}

/// θ or φ of directions in degrees, to a billionth: what an image's name says comes back bit by bit.
pub(super) fn angles(btf: &Btf, name: &str) -> Vec<f64> {
    let directions = if name.starts_with("view") { btf.views() } else { btf.lights() };
    let rounded = |degrees: f64| (degrees * 1e9).round() / 1e9;
    let angle = |direction: &Direction| if name.ends_with("theta") { direction.degrees().0 } else { direction.degrees().1 };
    directions.iter().map(angle).map(rounded).collect()
}

/// Names of all arrays.
pub(super) fn names() -> Vec<&'static str> {
    ANGLES.iter().map(|(name, _)| *name).chain([RADIANCE, SLOT_LIGHT]).collect()
}
