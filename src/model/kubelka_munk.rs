//! Reflectance and transmittance of a paint film (Kubelka, Munk 1931; Kubelka 1948), in f64.
//!
//! Everything is written in s = S·d and k = K·d, never in K/S, so that a film without scattering, one without absorption,
//! one of no thickness and an opaque one need no case of their own. The f32 side is `kernels/common/film.wgsl`.

/// A paint film in one colour channel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Film {
    /// R: fraction of diffuse light that comes back from the film over black.
    pub reflectance: f64,
    /// T: fraction of diffuse light that passes through it.
    pub transmittance: f64,
}

impl Film {
    /// No film at all: R = 0, T = 1.
    pub const NONE: Self = Self { reflectance: 0.0, transmittance: 1.0 };

    /// The film of `scattering` s = S·d and `absorption` k = K·d, both at least 0 (thesis eq. 3.7).
    ///
    /// With q = √(k(k + 2s)) = bSd and t = tanh(q)/q: R = s·t/(1 + (s + k)t), T = 1/(cosh(q)(1 + (s + k)t)), which are
    /// sinh(q)/c and b/c with numerator and denominator divided by b·cosh(q).
    #[must_use]
    pub fn new(scattering: f64, absorption: f64) -> Self {
        let q = absorption.sqrt() * (absorption + 2.0 * scattering).sqrt();
        let t = if q > 0.0 { q.tanh() / q } else { 1.0 };
        let denominator = 1.0 + (scattering + absorption) * t;
        // 1/cosh(q), without the overflow of cosh.
        let decay = 2.0 * (-q).exp() / (1.0 + (-2.0 * q).exp());
        Self { reflectance: scattering * t / denominator, transmittance: decay / denominator }
    }

    /// This film on top of `below`: R = R₁ + T₁²R₂/(1 − R₁R₂), T = T₁T₂/(1 − R₁R₂) (thesis eq. 3.8).
    ///
    /// R is seen from above, and from below a stack of different films reflects otherwise: `below` may be a stack, this film
    /// may not. So films are stacked from the bottom up, and a ground goes in first.
    #[must_use]
    pub fn over(self, below: Self) -> Self {
        let between = 1.0 - self.reflectance * below.reflectance.min(WHITEST);
        Self { reflectance: self.over_substrate(below.reflectance), transmittance: self.transmittance * below.transmittance / between }
    }

    /// Reflectance of this film on an opaque `substrate`: R + T²ρ/(1 − Rρ) (thesis eq. 3.9).
    ///
    /// Measured reflectances may exceed 1, where the geometric series behind the formula has no sum. Such a substrate counts
    /// as white, and what it has more than that is seen through the film once: T²(ρ − 1).
    #[must_use]
    pub fn over_substrate(self, substrate: f64) -> f64 {
        let white = substrate.min(WHITEST);
        let through = self.transmittance * self.transmittance;
        self.reflectance + through * (white / (1.0 - self.reflectance * white) + (substrate - white))
    }
}

/// The whitest substrate that the series between film and substrate is summed for: the last f64 below 1.
const WHITEST: f64 = 1.0 - 0.5 * f64::EPSILON;

/// s = S·d and k = K·d of the film that reflects `over_white` on a white ground and `over_black` on a black one (Curtis et al. 1997,
/// section 5.1); `None` unless 0 < R_b < R_w < 1, in linear light.
///
/// Their form is a = (R_w + (R_b − R_w + 1)/R_b)/2, b = √(a² − 1), s = acoth((b² − (a − R_w)(a − 1))/(b(1 − R_w)))/b, k = s(a − 1). It
/// loses digits in a − 1 where a is near 1, in acoth where its argument is, and overflows with 1/R_b. With u = (a − 1)R_b and
/// v = b·R_b, in which it is equal to what stands here, none of that is left: u = (1 − R_w)(1 − R_b)/2, v = √(u(u + 2R_b)),
/// z = 2v/((1 − R_b)(1 + R_w)), s = atanh(z)·R_b/v, k = atanh(z)·u/v.
#[must_use]
pub fn film_of(over_white: f64, over_black: f64) -> Option<(f64, f64)> {
    if !(0.0 < over_black && over_black < over_white && over_white < 1.0) {
        return None;
    }
    let u = 0.5 * (1.0 - over_white) * (1.0 - over_black);
    let v = u.sqrt() * (u + 2.0 * over_black).sqrt();
    let z = 2.0 * v / ((1.0 - over_black) * (1.0 + over_white));
    // 1 - z² without the difference of two numbers near 1.
    let rest = 4.0 * (over_white - over_black) / ((1.0 - over_black) * (1.0 + over_white).powi(2));
    let atanh = if z < 0.5 { z.atanh() } else { z.ln_1p() - 0.5 * rest.ln() };
    Some((atanh * over_black / v, atanh * u / v))
}

/// Reflectance of an opaque coat: R∞ = 1/(1 + Q + √(Q(Q + 2))), Q = K/S; 0 without scattering.
#[must_use]
pub fn opaque_reflectance(scattering: f64, absorption: f64) -> f64 {
    if scattering <= 0.0 {
        return 0.0;
    }
    let ratio = absorption / scattering;
    1.0 / (1.0 + ratio + (ratio * (ratio + 2.0)).sqrt())
}
