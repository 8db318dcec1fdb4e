//! Which sample stands for a pair of a view and a light.

use super::{BtfError, Direction, Map, Pair};

/// The sample of each pair, a row a view and a column a light. A pair that was not measured has the sample of the nearest light of the same
/// view; a view without any sample has the row of the nearest view that has one. Of samples of the same pair the first counts.
///
/// # Errors
/// [`BtfError::Empty`] without pairs, [`BtfError::PairOutOfRange`] if one refers to a direction that is not there.
pub fn nearest_samples(pairs: &[Pair], views: &[Direction], lights: &[Direction]) -> Result<Map<usize>, BtfError> {
    if let Some(&pair) = pairs.iter().find(|pair| pair.view >= views.len() || pair.light >= lights.len()) {
        return Err(BtfError::PairOutOfRange { pair, views: views.len(), lights: lights.len() });
    }
    // (light, sample) of each view.
    let mut measured: Vec<Vec<(usize, usize)>> = vec![Vec::new(); views.len()];
    for (sample, pair) in pairs.iter().enumerate() {
        measured[pair.view].push((pair.light, sample));
    }
    let with_samples: Vec<(usize, usize)> = (0..views.len()).filter(|&view| !measured[view].is_empty()).map(|view| (view, view)).collect();
    let mut samples = Vec::with_capacity(views.len() * lights.len());
    for view in 0..views.len() {
        let row = nearest(views, view, &with_samples).ok_or(BtfError::Empty)?;
        let mut own = vec![None; lights.len()];
        for &(light, sample) in measured[row].iter().rev() {
            own[light] = Some(sample);
        }
        for (light, own) in own.into_iter().enumerate() {
            samples.push(own.or_else(|| nearest(lights, light, &measured[row])).ok_or(BtfError::Empty)?);
        }
    }
    Map::new(lights.len(), views.len(), samples).map_err(|_| BtfError::Empty)
}

/// The value of the candidate (direction, value) whose direction is nearest; of equally near ones the first.
fn nearest(directions: &[Direction], wanted: usize, candidates: &[(usize, usize)]) -> Option<usize> {
    let wanted = directions[wanted].vector();
    let far = |direction: usize| directions[direction].vector().distance_squared(wanted);
    candidates.iter().min_by(|(a, _), (b, _)| far(*a).total_cmp(&far(*b))).map(|(_, value)| *value)
}
