//! A sheet of paints: each over black, over white and over a checker of both, at several thicknesses.

use font8x8::{BASIC_FONTS, UnicodeFonts};

use super::{PipelineError, Progress, tiles::run};
use crate::{
    data::Map,
    gpu::Gpu,
    model::{Layer, Paint},
    stage::{KubelkaMunk, PaintStack},
};

/// Kubelka-Munk thicknesses of the columns: from a glaze to a coat that hides its ground.
const THICKNESSES: [f64; 7] = [0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0];
/// The thickest.
const THICKEST: f64 = THICKNESSES[THICKNESSES.len() - 1];

/// Pixels of the bands of one ground, of a swatch, of a square of the checker, and between swatches.
const BAND: usize = 28;
const SWATCH: [usize; 2] = [3 * BAND, 48];
const CHECK: usize = 7;
const GAP: usize = 6;
/// Pixels of a letter, which is a square.
const LETTER: usize = 8;
const MARGIN: usize = 12;
/// Reflectances of the black and the white ground: drawing card, not the ends of the scale.
const BLACK: f32 = 0.03;
const WHITE: f32 = 0.9;

/// Swatches of `paints`, one row each, with their names and thicknesses: linear RGBA.
///
/// # Errors
/// [`PipelineError::Paint`] if a paint is none, [`PipelineError::Gpu`] if the sheet does not fit the adapter.
pub fn swatches(gpu: &Gpu, paints: &[Paint], progress: &Progress) -> Result<Map<[f32; 4]>, PipelineError> {
    let kubelka_munk = KubelkaMunk::new(gpu)?;
    let [width, height] = [THICKNESSES.len() * SWATCH[0], SWATCH[1]];
    let grounds: Vec<_> = (0..width * height)
        .map(|pixel| ground(pixel % width % SWATCH[0], pixel / width))
        .map(|reflectance| [reflectance, reflectance, reflectance, 0.0])
        .collect();
    #[expect(clippy::cast_possible_truncation, reason = "a part of the thickest")]
    let drawn: Vec<_> = (0..width * height).map(|pixel| (THICKNESSES[pixel % width / SWATCH[0]] / THICKEST) as f32).collect();
    let drawn = gpu.upload("drawn", &drawn)?;
    let stacks = run(gpu, progress, "kubelka_munk", [paints.len() * width * height, 1], |recorder| {
        let paint = |paint: &Paint| {
            let layer = Layer::new(paint.clone(), THICKEST, 0.0).checked()?;
            let mut stack = PaintStack::new(
                gpu,
                gpu.upload("ground", &grounds)?,
                gpu.zeros("coats", grounds.len())?,
                gpu.zeros("heights", grounds.len())?,
                1,
                1,
            )?;
            kubelka_munk.record(recorder, &mut stack, &drawn, &[layer])?;
            Ok::<_, PipelineError>(stack)
        };
        paints.iter().map(paint).collect::<Result<Vec<_>, _>>()
    })?;
    let rows = stacks.iter().map(|stack| stack.painted.read(gpu)).collect::<Result<Vec<_>, _>>()?;

    let names = paints.iter().map(|paint| paint.name.chars().count()).max().unwrap_or(0) * LETTER;
    let [left, top] = [MARGIN + names + 2 * GAP, MARGIN + LETTER + GAP];
    let size = [left + THICKNESSES.len() * (SWATCH[0] + GAP) + MARGIN, top + paints.len() * (height + GAP) + MARGIN];
    let mut sheet = Sheet { size, pixels: vec![[1.0; 4]; size[0] * size[1]] };
    for (column, thickness) in THICKNESSES.iter().enumerate() {
        sheet.write(&format!("d = {thickness}"), [left + column * (SWATCH[0] + GAP), MARGIN]);
    }
    for (row, (paint, texels)) in paints.iter().zip(rows).enumerate() {
        let y = top + row * (height + GAP);
        sheet.write(&paint.name, [MARGIN, y + (height - LETTER) / 2]);
        for (pixel, texel) in texels.iter().enumerate() {
            let (column, [r, g, b, _]) = (pixel % width, *texel);
            sheet.set([left + column + column / SWATCH[0] * GAP, y + pixel / width], [r, g, b, 1.0]);
        }
    }
    Ok(Map::new(size[0], size[1], sheet.pixels)?)
}

/// Reflectance of the ground of a swatch: a band of black, one of white, one of squares of both.
fn ground(column: usize, row: usize) -> f32 {
    let black = match column / BAND {
        0 => true,
        1 => false,
        _ => (column % BAND / CHECK + row / CHECK).is_multiple_of(2),
    };
    if black { BLACK } else { WHITE }
}

/// A picture that is being drawn.
struct Sheet {
    size: [usize; 2],
    pixels: Vec<[f32; 4]>,
}

impl Sheet {
    fn set(&mut self, [column, row]: [usize; 2], pixel: [f32; 4]) {
        self.pixels[row * self.size[0] + column] = pixel;
    }

    /// Writes `text` in black, its upper left corner at `at`. A letter that the font does not have is a question mark.
    fn write(&mut self, text: &str, at: [usize; 2]) {
        for (index, letter) in text.chars().enumerate() {
            let glyph = BASIC_FONTS.get(letter).or_else(|| BASIC_FONTS.get('?')).unwrap_or_default();
            for (row, bits) in glyph.into_iter().enumerate() {
                for column in (0..LETTER).filter(|column| bits >> column & 1 == 1) {
                    self.set([at[0] + index * LETTER + column, at[1] + row], [0.0, 0.0, 0.0, 1.0]);
                }
            }
        }
    }
}
