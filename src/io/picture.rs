//! Pictures: `.png` for people, sRGB with 8 bits, and `.exr` for numbers, linear with 32-bit floats.

use std::{io::Cursor, path::Path};

use exr::prelude::{AnyChannel, AnyChannels, FlatSamples, Image, ReadChannels, ReadLayers, SpecificChannels, Vec2, WritableImage};
use image::{ExtendedColorType, ImageFormat};

use super::IoError;
use crate::{
    data::Map,
    model::color::{linear_from_srgb, srgb_from_linear},
};

#[derive(Clone, Copy)]
enum Format {
    Png,
    Exr,
}

fn format(path: &Path) -> Result<Format, IoError> {
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase());
    match extension.as_deref() {
        Some("png") => Ok(Format::Png),
        Some("exr") => Ok(Format::Exr),
        other => Err(IoError::Extension { path: path.to_owned(), found: other.map_or("none".to_owned(), |other| format!(".{other}")) }),
    }
}

/// Writes linear RGBA, premultiplied. `.png`: divided by alpha, held to 0..=1, rounded to 8-bit sRGB. `.exr`: as it is.
///
/// # Errors
/// [`IoError`] if the extension is neither, a pixel of a `.png` is NaN, or the system refuses to write.
pub fn write(path: &Path, picture: &Map<[f32; 4]>) -> Result<(), IoError> {
    let bytes = match format(path)? {
        Format::Png => png_bytes(path, picture)?,
        Format::Exr => exr_bytes(path, picture)?,
    };
    super::write(path, &bytes)
}

/// Writes linear RGBA, premultiplied, and further channels by their names, `[row][column]` each, as 32-bit floats.
///
/// # Errors
/// [`IoError`] if the extension is not `.exr`, which alone has them, or the system refuses to write.
///
/// # Panics
/// If a channel is not as large as the picture: the caller's bug.
pub fn write_channels(path: &Path, picture: &Map<[f32; 4]>, channels: Vec<(&str, Vec<f32>)>) -> Result<(), IoError> {
    let Format::Exr = format(path)? else {
        return Err(IoError::Extension { path: path.to_owned(), found: ".png, which has no further channels".to_owned() });
    };
    let size = (picture.width(), picture.height());
    let color = |index: usize| picture.values().iter().map(|pixel| pixel[index]).collect::<Vec<_>>();
    let all = [("R", color(0)), ("G", color(1)), ("B", color(2)), ("A", color(3))].into_iter().chain(channels);
    let list = all.map(|(name, values)| {
        assert_eq!(values.len(), picture.values().len(), "pixels of channel \"{name}\"");
        AnyChannel::new(name, FlatSamples::F32(values))
    });
    let mut bytes = Cursor::new(Vec::new());
    let image = Image::from_channels(size, AnyChannels::sort(list.collect()));
    image.write().to_buffered(&mut bytes).map_err(|error| failed(path, &error))?;
    super::write(path, &bytes.into_inner())
}

/// Reads a picture as linear RGBA, premultiplied.
///
/// # Errors
/// [`IoError`] if the extension is neither `.png` nor `.exr`, or the picture cannot be read.
pub fn read(path: &Path) -> Result<Map<[f32; 4]>, IoError> {
    let format = format(path)?;
    let bytes = std::fs::read(path).map_err(|source| IoError::Read { file: path.display().to_string(), source })?;
    match format {
        Format::Png => from_png(path, &bytes),
        Format::Exr => from_exr(path, bytes),
    }
}

fn png_bytes(path: &Path, picture: &Map<[f32; 4]>) -> Result<Vec<u8>, IoError> {
    let is_nan = |pixel: &[f32; 4]| pixel.iter().any(|value| value.is_nan());
    if let Some(index) = picture.values().iter().position(is_nan) {
        let (column, row) = (index % picture.width(), index / picture.width());
        return Err(IoError::NotANumber { path: path.to_owned(), column, row });
    }
    let pixels: Vec<[u8; 4]> = picture.values().iter().map(|&pixel| codes(pixel)).collect();
    encoded_png(path, pixels.as_flattened(), [picture.width(), picture.height()], ExtendedColorType::Rgba8)
}

/// The bytes of a PNG of these codes, for the file `path`.
pub(super) fn encoded_png(path: &Path, codes: &[u8], size: [usize; 2], color: ExtendedColorType) -> Result<Vec<u8>, IoError> {
    let mut bytes = Cursor::new(Vec::new());
    let [Ok(width), Ok(height)] = size.map(u32::try_from) else { return Err(failed(path, &"more than 2^32 rows or columns")) };
    image::write_buffer_with_format(&mut bytes, codes, width, height, color, ImageFormat::Png).map_err(|error| failed(path, &error))?;
    Ok(bytes.into_inner())
}

/// sRGB codes of a pixel, alpha not premultiplied.
fn codes(pixel: [f32; 4]) -> [u8; 4] {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "held to 0..=1 before")]
    let code = |value: f64| (value.clamp(0.0, 1.0) * 255.0).round() as u8;
    let [r, g, b, alpha] = pixel.map(f64::from);
    let color = |value: f64| if alpha > 0.0 { code(srgb_from_linear((value / alpha).clamp(0.0, 1.0))) } else { 0 };
    [color(r), color(g), color(b), code(alpha)]
}

fn from_png(path: &Path, bytes: &[u8]) -> Result<Map<[f32; 4]>, IoError> {
    let picture = image::load_from_memory_with_format(bytes, ImageFormat::Png).map_err(|error| failed(path, &error))?.into_rgba8();
    #[expect(clippy::cast_possible_truncation, reason = "to the nearest f32")]
    let pixel = |[r, g, b, alpha]: [u8; 4]| {
        let alpha = f64::from(alpha) / 255.0;
        let [r, g, b] = [r, g, b].map(|code| (linear_from_srgb(f64::from(code) / 255.0) * alpha) as f32);
        [r, g, b, alpha as f32]
    };
    let values = picture.pixels().map(|code| pixel(code.0)).collect();
    Ok(Map::new(picture.width() as usize, picture.height() as usize, values)?)
}

fn exr_bytes(path: &Path, picture: &Map<[f32; 4]>) -> Result<Vec<u8>, IoError> {
    let channels = SpecificChannels::rgba(|Vec2(column, row)| <(f32, f32, f32, f32)>::from(picture[(column, row)]));
    let mut bytes = Cursor::new(Vec::new());
    let image = Image::from_channels((picture.width(), picture.height()), channels);
    image.write().to_buffered(&mut bytes).map_err(|error| failed(path, &error))?;
    Ok(bytes.into_inner())
}

fn from_exr(path: &Path, bytes: Vec<u8>) -> Result<Map<[f32; 4]>, IoError> {
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .rgba_channels(
            |Vec2(width, height), _| Map::from_fn(width, height, |_, _| [0.0; 4]),
            |picture, Vec2(column, row), (r, g, b, alpha): (f32, f32, f32, f32)| picture[(column, row)] = [r, g, b, alpha],
        )
        .first_valid_layer()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))
        .map_err(|error| failed(path, &error))?;
    Ok(image.layer_data.channel_data.pixels)
}

fn failed(path: &Path, error: &dyn std::fmt::Display) -> IoError {
    IoError::Picture { path: path.to_owned(), message: error.to_string() }
}
