//! What surfaces are made of: a Lafortune lobe over a diffuse part in every texel, in the form that `fit` recovers.
//!
//! A lobe whose largest |C| is 1 reflects at most the share 2ρ_s/(n + 2) of the light, whatever the view: C·(ω_i ω_o) is the cosine to a
//! vector no longer than 1, and ∫ cosⁿα cos θ dω over a hemisphere is at most 2π/(n + 2). Materials are made from that share, diffuse and
//! specular share together below 1.

use super::{
    SynthPlace,
    height_field::weave,
    noise::{fractal, noise, random, smooth},
};

/// A kind of material.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SynthReflectance {
    /// Diffuse in mottled colour: no highlights.
    Matte,
    /// Coloured, below a clear and even gloss.
    Plastic,
    /// Coloured highlights, hardly anything diffuse.
    Metal,
    /// Two colours of thread, each shining across its length.
    Silk,
    /// Glossy dark spots on a matte bright ground.
    TwoTone,
}

/// Reflectance f_r = ρ_d + ρ_s·(C·ω_i ω_o)ⁿ of a texel, π·f_r, directions in its own frame (Lafortune et al. 1997).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SynthTexel {
    /// ρ_d per channel.
    pub diffuse: [f64; 3],
    /// ρ_s per channel.
    pub specular: [f64; 3],
    /// (C_x, C_y, C_z, n).
    pub lobe: [f64; 4],
}

impl SynthTexel {
    /// Share of the light, per channel, that it reflects at most towards any view.
    #[must_use]
    pub fn albedo_bound(&self) -> [f64; 3] {
        let [x, y, z, n] = self.lobe;
        let longest = x.abs().max(y.abs()).max(z.abs());
        [0, 1, 2].map(|channel| self.diffuse[channel] + self.specular[channel] * longest.powf(n) * 2.0 / (n + 2.0))
    }

    /// A texel whose lobe reflects at most `share` per channel; the largest |C| must be 1.
    fn new(diffuse: [f64; 3], share: [f64; 3], [x, y, z]: [f64; 3], n: f64) -> Self {
        Self { diffuse, specular: share.map(|share| share * 0.5 * (n + 2.0)), lobe: [x, y, z, n] }
    }
}

/// C of a lobe around the mirrored direction.
const MIRROR: [f64; 3] = [-1.0, -1.0, 1.0];

impl SynthReflectance {
    /// All, in the order in which they are offered.
    pub const ALL: [Self; 5] = [Self::Matte, Self::Plastic, Self::Metal, Self::Silk, Self::TwoTone];

    /// Its name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Matte => "matte",
            Self::Plastic => "plastic",
            Self::Metal => "metal",
            Self::Silk => "silk",
            Self::TwoTone => "two-tone",
        }
    }

    /// Reflectance at a place.
    #[must_use]
    pub fn texel(self, place: SynthPlace, seed: u32) -> SynthTexel {
        let hue = random([0.0; 2], [1.0; 2], seed, 100);
        let mottle = |low: f64, high: f64| low + (high - low) * fractal(place, 8.0, seed, 101);
        match self {
            Self::Matte => {
                let (bright, drift) = (mottle(0.6, 1.3), 0.12 * noise(place, 5.0, seed, 102));
                SynthTexel::new(color(hue + drift).map(|c| c * bright), [0.0; 3], MIRROR, 1.0)
            }
            Self::Plastic => {
                let bright = mottle(0.7, 1.1);
                SynthTexel::new(color(hue).map(|c| c * bright), [0.05; 3], MIRROR, 20.0 + 20.0 * noise(place, 4.0, seed, 102))
            }
            Self::Metal => {
                // Between copper and silver.
                let metal = [0.75, 0.75 - 0.2 * hue, 0.75 - 0.4 * hue].map(|c| c * mottle(0.7, 1.1));
                SynthTexel::new(metal.map(|c| 0.1 * c), metal, MIRROR, 5.0 + 7.0 * noise(place, 6.0, seed, 102))
            }
            Self::Silk => {
                let along_y = weave(place).1;
                // Along a thread light is mirrored, across it is spread.
                let spread = 0.25;
                let (c, hue) = if along_y { ([-spread, -1.0, 1.0], hue) } else { ([-1.0, -spread, 1.0], hue + 0.4) };
                let bright = mottle(0.5, 0.9);
                let diffuse = color(hue).map(|c| c * bright);
                SynthTexel::new(diffuse, diffuse.map(|c| 0.1 + 0.3 * c), c, 10.0)
            }
            Self::TwoTone => {
                let spot = smooth((fractal(place, 5.0, seed, 102) - 0.48) / 0.03);
                let (ground, dark) = (color(hue), color(hue + 0.5));
                let bright = mottle(0.8, 1.2);
                let diffuse = [0, 1, 2].map(|c| bright * (ground[c] + (0.25 * dark[c] - ground[c]) * spot));
                SynthTexel::new(diffuse, [0.06 * spot; 3], MIRROR, 16.0)
            }
        }
    }
}

impl std::fmt::Display for SynthReflectance {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.write_str(self.name())
    }
}

/// A colour of the hue circle 0..1, each channel from 0.1 to 0.6.
fn color(hue: f64) -> [f64; 3] {
    [0.0, 1.0, 2.0].map(|third| 0.35 + 0.25 * (std::f64::consts::TAU * (hue - third / 3.0)).cos())
}
