//! Twin of `lpca_lift`.

/// Of a cluster's members, each its values and its weights: `[weight][value]` Σ_t w_t (x_td − c_d) over those that are not masked, and `[value]`
/// their number.
#[must_use]
pub fn lpca_lift(members: &[(&[Option<f64>], &[f64])], centre: &[f64], weights: usize) -> (Vec<Vec<f64>>, Vec<f64>) {
    let valid = |value: usize| members.iter().filter_map(move |(texel, own)| texel[value].map(|x| (x - centre[value], own)));
    let sum = |weight: usize| (0..centre.len()).map(|value| valid(value).map(|(x, own)| own[weight] * x).sum()).collect();
    ((0..weights).map(sum).collect(), (0..centre.len()).map(|value| valid(value).map(|_| 1.0).sum()).collect())
}
