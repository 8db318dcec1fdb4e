//! Twin of `lpca_covariance`.

/// Mean `[coordinate]` and covariance `[row][column]` of points, by the textbook: the mean first.
#[must_use]
pub fn lpca_covariance(points: &[&[f64]]) -> (Vec<f64>, Vec<Vec<f64>>) {
    let rank = points.first().map_or(0, |point| point.len());
    #[expect(clippy::cast_precision_loss, reason = "a number of points")]
    let average = |of: &dyn Fn(&[f64]) -> f64| points.iter().map(|point| of(point)).sum::<f64>() / points.len() as f64;
    let mean: Vec<f64> = (0..rank).map(|row| average(&|point| point[row])).collect();
    let product = |row: usize, column: usize| average(&|point| (point[row] - mean[row]) * (point[column] - mean[column]));
    let covariance = (0..rank).map(|row| (0..rank).map(|column| product(row, column)).collect()).collect();
    (mean, covariance)
}
