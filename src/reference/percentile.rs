//! Twin of `percentile`: a sort, and numpy's linear rule (Hyndman and Fan 1996, type 7).

/// The `quantile` (0 to 1) of the `values` that are not masked (negative), or `None` without such.
#[must_use]
pub fn percentile(values: &[f64], quantile: f64) -> Option<f64> {
    let mut sorted: Vec<f64> = values.iter().copied().filter(|value| *value >= 0.0).collect();
    sorted.sort_by(f64::total_cmp);
    #[expect(clippy::cast_precision_loss, reason = "samples are counted in thousands")]
    let position = quantile.clamp(0.0, 1.0) * sorted.len().checked_sub(1)? as f64;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an index of the list")]
    let lower = position.floor() as usize;
    let upper = (lower + 1).min(sorted.len() - 1);
    Some(sorted[lower] + (sorted[upper] - sorted[lower]) * (position - position.floor()))
}
