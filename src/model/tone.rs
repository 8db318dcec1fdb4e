//! Linear light as a screen shows it.

/// How linear light that may exceed 1 becomes what a screen has, 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ToneMap {
    /// What exceeds 1 is 1: colours below are exact.
    Clip,
    /// Khronos PBR Neutral: colours up to 0.76 keep hue and differences, brighter ones approach white.
    #[default]
    Neutral,
}

/// A tone map and the exposure before it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Development {
    /// Powers of two that light is multiplied by.
    pub exposure: f64,
    /// What follows.
    pub tone_map: ToneMap,
}

impl Development {
    /// A pixel as the screen shows it, both linear RGBA, premultiplied.
    #[must_use]
    pub fn develop(&self, pixel: [f32; 4]) -> [f32; 4] {
        let [r, g, b, alpha] = pixel.map(f64::from);
        if alpha <= 0.0 {
            return pixel;
        }
        let exposed = [r, g, b].map(|value| value / alpha * self.exposure.exp2());
        let [r, g, b] = match self.tone_map {
            ToneMap::Clip => exposed.map(|value| value.clamp(0.0, 1.0)),
            ToneMap::Neutral => neutral(exposed.map(|value| value.max(0.0))),
        };
        #[expect(clippy::cast_possible_truncation, reason = "to the nearest f32")]
        [r * alpha, g * alpha, b * alpha, alpha].map(|value| value as f32)
    }
}

/// A pixel, linear RGBA and premultiplied, in front of white.
#[must_use]
pub fn on_white([r, g, b, alpha]: [f32; 4]) -> [f32; 4] {
    let [r, g, b] = [r, g, b].map(|value| value + 1.0 - alpha);
    [r, g, b, 1.0]
}

/// Linear sRGB of 0 or more, held below 1 (Khronos Group 2024, PBR Neutral Tone Mapper): what glass adds at normal incidence, 4 %, is taken
/// off; peaks from 0.8 on are compressed, and lose their colour as they do.
fn neutral(color: [f64; 3]) -> [f64; 3] {
    const F90: f64 = 0.04;
    const START: f64 = 0.8 - F90;
    const DESATURATION: f64 = 0.15;
    let least = color.into_iter().fold(f64::INFINITY, f64::min);
    let offset = if least < 2.0 * F90 { least - least * least / (4.0 * F90) } else { F90 };
    let color = color.map(|value| value - offset);
    let peak = color.into_iter().fold(0.0, f64::max);
    if peak < START {
        return color;
    }
    let rest = 1.0 - START;
    let compressed = 1.0 - rest * rest / (peak + rest - START);
    let share = 1.0 / (DESATURATION * (peak - compressed) + 1.0);
    color.map(|value| value * compressed / peak * share + compressed * (1.0 - share))
}
