//! One texel's measurement, views × lights, through the steps of the fit (thesis fig. 3.4).

use crate::{
    data::{Btf, Direction, Map, Svbrdf},
    model::lafortune,
};

/// What a material holds of a texel under one pair of directions, linear.
#[derive(Debug, Clone, Copy)]
pub struct Reflected {
    /// ρ_d.
    pub diffuse: [f64; 3],
    /// (C·(ω_i ω_o))^n.
    pub lobe: f64,
    /// ρ_s times the lobe.
    pub specular: [f64; 3],
}

/// Evaluates the fitted reflectance of texel (column, row).
pub fn reflected(svbrdf: &Svbrdf, at: (usize, usize), view: Direction, light: Direction) -> Reflected {
    let lobe = lafortune(svbrdf.lobe[at].map(f64::from), (view.vector() * light.vector()).to_array());
    Reflected { diffuse: svbrdf.diffuse[at].map(f64::from), lobe, specular: svbrdf.specular[at].map(|rho| f64::from(rho) * lobe) }
}

/// An image of views (rows) by lights (columns); none where there is no such pair, or it is masked.
pub type Measurement = Map<Option<[f64; 3]>>;

/// Each step of the fit, and below it what the material has in its place.
pub struct Steps {
    /// L; and ρ_d + ρ_s lobe, times cos θ.
    pub radiance: [Measurement; 2],
    /// f = L/cos θ; and ρ_d + ρ_s lobe.
    pub reflectance: [Measurement; 2],
    /// s = max(f − ρ_d, 0); and ρ_s lobe.
    pub specular: [Measurement; 2],
    /// Mean of s over the channels; and the lobe.
    pub mean: [Measurement; 2],
}

/// The steps of texel `at` with the radiance `measured` in each pair.
pub fn steps(btf: &Btf, svbrdf: &Svbrdf, at: [usize; 2], measured: &[Option<[f32; 3]>]) -> Steps {
    let mut radiance: Measurement = Map::from_fn(btf.lights().len(), btf.views().len(), |_, _| None);
    for (pair, channels) in btf.pairs().iter().zip(measured) {
        radiance[(pair.light, pair.view)] = channels.map(|channels| channels.map(f64::from));
    }
    // What `of` makes of each measured value, what the material reflects there, and cos θ of the light.
    let step = |of: &dyn Fn([f64; 3], Reflected, f64) -> [f64; 3]| {
        Map::from_fn(radiance.width(), radiance.height(), |light, view| {
            let (view_direction, light_direction) = (btf.views()[view], btf.lights()[light]);
            let found = reflected(svbrdf, (at[0], at[1]), view_direction, light_direction);
            radiance[(light, view)].map(|channels| of(channels, found, light_direction.theta.cos()))
        })
    };
    let sum = |a: [f64; 3], b: [f64; 3]| [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
    let above = |radiance: [f64; 3], found: Reflected, cosine: f64| [0, 1, 2].map(|c| (radiance[c] / cosine - found.diffuse[c]).max(0.0));
    Steps {
        radiance: [
            step(&|radiance, _, _| radiance),
            step(&|_, found, cosine| sum(found.diffuse, found.specular).map(|value| value * cosine)),
        ],
        reflectance: [
            step(&|radiance, _, cosine| radiance.map(|value| value / cosine)),
            step(&|_, found, _| sum(found.diffuse, found.specular)),
        ],
        specular: [step(&above), step(&|_, found, _| found.specular)],
        mean: [
            step(&|radiance, found, cosine| [above(radiance, found, cosine).iter().sum::<f64>() / 3.0; 3]),
            step(&|_, found, _| [found.lobe; 3]),
        ],
    }
}
