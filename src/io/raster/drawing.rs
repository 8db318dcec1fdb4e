//! Images as drawn thickness.

use std::{fs::File, path::Path};

use image::{DynamicImage, ImageDecoder};

use super::{Decoder, Picture, guarded, library_error, read_header, read_texels};
use crate::{
    data::Map,
    io::{IoError, archive},
};

/// Luma of R, G and B (ITU-R BT.709).
const LUMA: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// Reads an image as a thickness from 0 to 1, the top row first.
///
/// Of integers it is the code over the largest code, not decoded from sRGB: what looks half as bright is half as thick. Floating-point
/// numbers are taken as they are and held to 0..=1. Of colours it is the luma, times the opacity where an image of integers has one; in
/// OpenEXR colours are multiplied by it already.
pub(in crate::io) fn drawing(path: &Path) -> Result<Map<f32>, IoError> {
    let file = path.display().to_string();
    let unreadable = |source| IoError::Read { file: file.clone(), source };
    let reader = File::open(path).map_err(unreadable)?;
    let declared = reader.metadata().map_err(unreadable)?.len();
    let bytes = archive::bounded(&file, declared, reader).map_err(unreadable)??;
    guarded(&file, || read(&file, &bytes))
}

fn read(file: &str, bytes: &[u8]) -> Result<Map<f32>, IoError> {
    let [width, height] = read_header(file, bytes)?.size;
    let values = match Decoder::open(file, bytes)? {
        Decoder::Library(decoder) => {
            let channels = usize::from(decoder.color_type().channel_count());
            let image = DynamicImage::from_decoder(decoder).map_err(|error| library_error(file, bytes, &error))?;
            match (image.as_flat_samples_u8(), image.as_flat_samples_u16()) {
                (Some(codes), _) => thickness(codes.samples, channels, f64::from(u8::MAX)),
                (_, Some(codes)) => thickness(codes.samples, channels, f64::from(u16::MAX)),
                (None, None) => return Err(IoError::Unsupported { file: file.to_owned(), found: format!("{:?} pixels", image.color()) }),
            }
        }
        _ => match read_texels(file, bytes, [width, height])? {
            Picture::Bytes(codes) => thickness(&codes, 3, f64::from(u8::MAX)),
            Picture::Words(codes) => thickness(&codes, 3, f64::from(u16::MAX)),
            Picture::Floats(values) => thickness(&values, 3, 1.0),
        },
    };
    if values.is_empty() {
        return Err(IoError::Damaged { file: file.to_owned(), message: "it has no texels".to_owned() });
    }
    match values.iter().position(|value| value.is_nan()) {
        Some(texel) => Err(IoError::NoThickness { file: file.to_owned(), column: texel % width, row: texel / width }),
        None => Ok(Map::new(width, height, values)?),
    }
}

/// Luma times opacity of texels of 1 to 4 channels: gray, gray and opacity, RGB, RGB and opacity; held to 0..=1.
fn thickness<T: Copy + Into<f64>>(values: &[T], channels: usize, full: f64) -> Vec<f32> {
    let texel = |texel: &[T]| {
        let value = |channel: usize| texel[channel].into() / full;
        let luma = if channels < 3 { value(0) } else { LUMA[0] * value(0) + LUMA[1] * value(1) + LUMA[2] * value(2) };
        let opacity = if channels.is_multiple_of(2) { value(channels - 1) } else { 1.0 };
        #[expect(clippy::cast_possible_truncation, reason = "rounds")]
        let rounded = (luma * opacity).clamp(0.0, 1.0) as f32;
        rounded
    };
    values.chunks_exact(channels).map(texel).collect()
}
