//! Twin of `kubelka_munk`: the hyperbolic functions as printed, in a = (S + K)/S and b = √(a² − 1), where they can be
//! evaluated; films too thick for them are halved and stacked.

use crate::{data::Map, model::Layer};

/// Reflectance R and transmittance T of the film of `scattering` s = S·d and `absorption` k = K·d (thesis eq. 3.7).
#[must_use]
pub fn film(scattering: f64, absorption: f64) -> [f64; 2] {
    let (s, k) = (scattering, absorption);
    // Where a is infinite, Beer and Lambert; where b is zero, the limit of (3.7) for K → 0.
    if s == 0.0 {
        return [0.0, (-k).exp()];
    }
    let a = (s + k) / s;
    let b = (a * a - 1.0).sqrt();
    if b == 0.0 {
        return [s / (1.0 + s), 1.0 / (1.0 + s)];
    }
    if b * s > 20.0 {
        let [r, t] = film(0.5 * s, 0.5 * k);
        // (3.8) for two equal films.
        let between = 1.0 - r * r;
        return [r + t * t * r / between, t * t / between];
    }
    let (sinh, cosh) = ((b * s).sinh(), (b * s).cosh());
    let c = a * sinh + b * cosh;
    [sinh / c, b / c]
}

/// `ground` (ρ_d in rgb, coverage in the fourth component) under `layer` of the thickness `drawn` (thesis eq. 3.9). A ground
/// above 1 counts as 1, and the rest is seen through the film once.
#[must_use]
pub fn kubelka_munk(ground: &Map<[f64; 4]>, drawn: &Map<f64>, layer: &Layer) -> Map<[f64; 4]> {
    Map::from_fn(ground.width(), ground.height(), |column, row| {
        let d = layer.thickness * drawn[(column, row)];
        let below = ground[(column, row)];
        let mut above = [0.0; 4];
        for channel in 0..3 {
            let [r, t] = film(layer.paint.s[channel] * d, layer.paint.k[channel] * d);
            let white = below[channel].min(1.0);
            // At R = 1 nothing passes and the quotient is 0/0.
            let repeated = if r < 1.0 { t * t * white / (1.0 - r * white) } else { 0.0 };
            above[channel] = r + repeated + t * t * (below[channel] - white);
        }
        // The cubic of slope 0 at both ends, through Bernstein's basis.
        let part = (drawn[(column, row)] / Layer::CLOSED).clamp(0.0, 1.0);
        let closed = part.powi(3) + 3.0 * part.powi(2) * (1.0 - part);
        above[3] = below[3] + (1.0 - below[3]) * closed;
        above
    })
}
