use overpaint::model::{Development, ToneMap, on_white};

use crate::support::{Worst, hold};

crate::suite! { plain: neutral_is_khronos, clipping_keeps_what_a_screen_has, exposure_is_in_stops, nothing_is_white; }

/// Values of the reference implementation (KhronosGroup/ToneMapping, PBR_Neutral, 2024), worked out by hand from its formula.
fn neutral_is_khronos() {
    let neutral = Development::default();
    let cases = [
        // Least 0.02: the offset is 0.02 - 6.25 0.02^2 = 0.0175.
        ([0.5, 0.02, 0.3], [0.4825, 0.0025, 0.2825]),
        // From 0.08 on it is 0.04.
        ([0.2, 0.2, 0.2], [0.16, 0.16, 0.16]),
        // Peak 1.96: compressed to 1 - 0.24^2/(1.96 - 0.52) = 0.96; share of colour 1/(0.15 (1.96 - 0.96) + 1) = 0.869565.
        ([2.0, 0.54, 0.29], [0.96, 0.96 / 1.15 * 0.5 / 1.96 + 0.96 * (1.0 - 1.0 / 1.15), 0.96 / 1.15 * 0.25 / 1.96 + 0.96 * (1.0 - 1.0 / 1.15)]),
    ];
    for (linear, expected) in cases {
        let [r, g, b]: [f64; 3] = linear;
        let found = neutral.develop([r as f32, g as f32, b as f32, 1.0]);
        let errors = (0..3).map(|channel| (f64::from(found[channel]) - expected[channel]).abs());
        // Inputs and outputs in single precision.
        hold("tone: Khronos neutral", errors.worst(), 3e-7);
        // Of half of a pixel half of it.
        let half = neutral.develop([0.5 * r as f32, 0.5 * g as f32, 0.5 * b as f32, 0.5]);
        hold("tone: coverage", (0..3).map(|channel| f64::from((half[channel] - 0.5 * found[channel]).abs())).worst(), 1e-7);
    }
    assert!(neutral.develop([1e6, 1e3, 0.0, 1.0])[..3].iter().all(|value| (0.0..=1.0).contains(value)));
    assert_eq!(neutral.develop([0.0; 4]), [0.0; 4]);
}

fn clipping_keeps_what_a_screen_has() {
    let clip = Development { tone_map: ToneMap::Clip, ..Development::default() };
    assert_eq!(clip.develop([0.25, 1.5, -0.5, 1.0]), [0.25, 1.0, 0.0, 1.0]);
}

fn exposure_is_in_stops() {
    let brighter = Development { exposure: 2.0, tone_map: ToneMap::Clip };
    assert_eq!(brighter.develop([0.125, 0.0625, 0.5, 1.0]), [0.5, 0.25, 1.0, 1.0]);
}

fn nothing_is_white() {
    assert_eq!(on_white([0.0; 4]), [1.0; 4]);
    assert_eq!(on_white([0.25, 0.0, 0.5, 0.5]), [0.75, 0.5, 1.0, 1.0]);
}
