use overpaint::{data::Map, gpu::Gpu, model::Boundary};

use crate::{
    parity::minify::levels,
    support::{
        hold,
        surface::{bumpy, plain},
    },
};

crate::suite! { gpu: every_level_has_the_mean_of_the_finest, ridges_become_roughness; }

fn every_level_has_the_mean_of_the_finest(gpu: &Gpu) {
    let levels = levels(gpu, &bumpy(61, 40, Boundary::Periodic, 4));
    let means = |painted: &Map<[f64; 4]>| {
        let sum = painted.values().iter().fold([0.0; 4], |sum: [f64; 4], texel| {
            [sum[0] + texel[0] * texel[3], sum[1] + texel[1] * texel[3], sum[2] + texel[2] * texel[3], sum[3] + texel[3]]
        });
        sum.map(|value| value / painted.values().len() as f64)
    };
    let finest = means(&levels[0].painted);
    for level in &levels[1..] {
        let mean = means(&level.painted);
        let worst = (0..4).map(|channel| (mean[channel] - finest[channel]).abs()).fold(0.0, f64::max);
        // Six levels, a rounding or two each.
        hold("minify: means of colour and coverage", worst, 1e-6);
    }
}

/// Slopes of 1/2 to either side: their mean is straight up and the variance of the slope is 1/4 along one axis, none along the other, 1/8 on
/// the mean of both. Twice that is 1/4; of lengths, 2(1 - cos)/cos is 0.236.
fn ridges_become_roughness(gpu: &Gpu) {
    let mut surface = plain(8, 8);
    let length = 1.25_f64.sqrt();
    surface.normals = Map::from_fn(8, 8, |x, _| [if x % 2 == 0 { 0.5 / length } else { -0.5 / length }, 0.0, 1.0 / length]);
    surface.painted = Map::from_fn(8, 8, |_, _| [0.5, 0.5, 0.5, 1.0]);
    for level in &levels(gpu, &surface)[1..] {
        for normal in level.normals.values() {
            hold("minify: mean normal of ridges", normal[0].hypot(normal[1]), 1e-6);
            hold("minify: roughness of ridges", (normal[3] - 2.0 * (length - 1.0)).abs(), 1e-6);
        }
    }
}
