//! Twin of `kubelka_munk`: the hyperbolic functions as printed, in a = (S + K)/S and b = √(a² − 1), where they can be
//! evaluated; films too thick for them are halved and stacked. (To make the stack first, without a ground, and to lay it on the ground in one
//! formula would be another way, but 1 − Rρ of a white stack on white has no digits left.)

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

/// A texel's paint and its height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PaintedTexel {
    /// Diffuse reflectance, R, G, B.
    pub reflectance: [f64; 3],
    /// How much of the texel is painted.
    pub coverage: f64,
    /// F₀ and α of the topmost surface.
    pub coat: [f64; 2],
    /// Texel widths, positive outwards.
    pub height: f64,
}

/// 1 − R of a film, as a sum of positive terms: (c − sinh(bS))/c with c = a·sinh(bS) + b·cosh(bS).
fn complement(scattering: f64, absorption: f64) -> f64 {
    let (s, k) = (scattering, absorption);
    if s == 0.0 {
        return 1.0;
    }
    let excess = k / s;
    let b = (excess * (excess + 2.0)).sqrt();
    if b == 0.0 {
        return 1.0 / (1.0 + s);
    }
    // coth(bS) is 1 long before the hyperbolic functions overflow.
    let coth = if b * s > 20.0 { 1.0 } else { 1.0 / (b * s).tanh() };
    (excess + b * coth) / (1.0 + excess + b * coth)
}

/// `ground` under `layers`, from the bottom up, each with its drawn thickness (thesis eqs. 3.8, 3.9). What a ground has above 1 is seen
/// through the whole stack once.
#[must_use]
pub fn kubelka_munk(ground: &Map<PaintedTexel>, layers: &[(&Layer, &Map<f64>)]) -> Map<PaintedTexel> {
    Map::from_fn(ground.width(), ground.height(), |column, row| {
        let below = ground[(column, row)];
        let drawn = || layers.iter().map(|(layer, drawn)| (*layer, drawn[(column, row)]));
        let reflectance = std::array::from_fn(|channel| {
            // Over the ground, as far as it is no more than white, and over black; and what passes through.
            let white = below.reflectance[channel].min(1.0);
            let mut stack = [white, 0.0];
            let mut through = 1.0;
            for (layer, drawn) in drawn() {
                let d = layer.thickness * drawn;
                let (s, k) = (layer.paint.s[channel] * d, layer.paint.k[channel] * d);
                let ([r, t], lost) = (film(s, k), complement(s, k));
                // 1 - R rho, of which both are parts that do not cancel.
                let between = |rho: f64| lost + r * (1.0 - rho);
                through *= t / between(stack[1]);
                stack = stack.map(|rho| r + t * t * rho / between(rho));
            }
            stack[0] + through * through * (below.reflectance[channel] - white)
        });
        // What each surface shows of itself from above: its own cover, less what those above cover.
        let covers: Vec<_> = std::iter::once((below.coat, below.coverage))
            .chain(drawn().map(|(layer, drawn)| ([layer.coat().f0(), layer.coat().alpha()], closed(drawn))))
            .collect();
        let (mut bare, mut coverage, mut coat) = (1.0, 0.0, [0.0; 2]);
        for (surface, cover) in covers.into_iter().rev() {
            (0..2).for_each(|part| coat[part] += bare * cover * surface[part]);
            coverage += bare * cover;
            bare *= 1.0 - cover;
        }
        PaintedTexel {
            reflectance,
            coverage,
            coat: if coverage > 0.0 { coat.map(|part| part / coverage) } else { below.coat },
            height: below.height + drawn().map(|(layer, drawn)| layer.rise(drawn)).sum::<f64>(),
        }
    })
}

/// The cubic of slope 0 at both ends, through Bernstein's basis.
fn closed(drawn: f64) -> f64 {
    let part = (drawn / Layer::CLOSED).clamp(0.0, 1.0);
    part.powi(3) + 3.0 * part.powi(2) * (1.0 - part)
}
