//! Colours as linear reflectances.

use color::{Srgb, parse_color};

use super::{
    RecipeFault,
    document::{Outcome, Value},
    error::shortened,
};
use crate::model::color::linear_from_srgb;

/// How far outside sRGB a colour may lie by the roundings of its conversion, in f32.
const TOLERANCE: f32 = 1e-4;

/// Linear reflectances of a colour: a text in any notation of CSS Color 4, or three numbers as they are.
pub fn reflectances(value: Value<'_>) -> Outcome<[f64; 3]> {
    if !value.is_text() {
        let [r, g, b] = value.array("a colour: a string such as \"#1d8f8a\", or three linear reflectances such as [0.02, 0.27, 0.25]")?;
        return Ok([r.number()?, g.number()?, b.number()?]);
    }
    let text = value.text()?;
    let found = shortened(text);
    let color = match parse_color(text) {
        Ok(color) => color.to_alpha_color::<Srgb>(),
        Err(error) => return Err(value.fault(RecipeFault::NoColor { found, message: error.to_string() })),
    };
    let [r, g, b, opacity] = color.components;
    if opacity != 1.0 {
        return Err(value.fault(RecipeFault::Translucent { found, opacity }));
    }
    for (channel, component) in ["red", "green", "blue"].into_iter().zip([r, g, b]) {
        if !(-TOLERANCE..=1.0 + TOLERANCE).contains(&component) {
            return Err(value.fault(RecipeFault::Gamut { found, channel, value: component }));
        }
    }
    Ok([r, g, b].map(|component| linear_from_srgb(f64::from(component.clamp(0.0, 1.0)))))
}
