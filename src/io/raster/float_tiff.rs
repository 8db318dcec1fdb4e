//! TIFF of floating-point numbers: 16, 32 or 64 bits, gray or RGB, alpha left out.

use std::io::Cursor;

use tiff::{
    ColorType, TiffError,
    decoder::{Decoder, DecodingResult},
    tags::{PlanarConfiguration, SampleFormat, Tag},
};

use crate::io::IoError;

/// A decoder that has read the header.
pub(super) struct FloatTiff<'a> {
    decoder: Decoder<Cursor<&'a [u8]>>,
    /// Values a texel.
    channels: usize,
    /// Columns and rows.
    pub size: [usize; 2],
}

impl<'a> FloatTiff<'a> {
    /// Reads the header; `None` if the values are integers.
    pub(super) fn open(file: &str, bytes: &'a [u8]) -> Result<Option<Self>, IoError> {
        let failed = |error| failure(file, bytes, error);
        let mut decoder = Decoder::new(Cursor::new(bytes)).map_err(failed)?;
        let formats = decoder.find_tag_unsigned_vec::<u16>(Tag::SampleFormat).map_err(failed)?.unwrap_or_default();
        if formats.is_empty() || formats.iter().any(|&format| format != SampleFormat::IEEEFP.to_u16()) {
            return Ok(None);
        }
        let unsupported = |found| IoError::Unsupported { file: file.to_owned(), found };
        let channels = match decoder.colortype().map_err(failed)? {
            ColorType::Gray(_) => 1,
            ColorType::GrayA(_) => 2,
            ColorType::RGB(_) => 3,
            ColorType::RGBA(_) => 4,
            other => return Err(unsupported(format!("TIFF of {other:?} floating-point pixels"))),
        };
        let planar = decoder.find_tag_unsigned::<u16>(Tag::PlanarConfiguration).map_err(failed)?;
        if channels > 1 && planar == Some(PlanarConfiguration::Planar.to_u16()) {
            return Err(unsupported("TIFF with a plane for each channel".to_owned()));
        }
        let (width, height) = decoder.dimensions().map_err(failed)?;
        Ok(Some(Self { decoder, channels, size: [width as usize, height as usize] }))
    }

    /// RGB of all texels.
    pub(super) fn decode(mut self, file: &str, bytes: &[u8]) -> Result<Vec<f32>, IoError> {
        let values: Vec<f32> = match self.decoder.read_image().map_err(|error| failure(file, bytes, error))? {
            DecodingResult::F16(values) => values.into_iter().map(f32::from).collect(),
            DecodingResult::F32(values) => values,
            DecodingResult::F64(values) => values.into_iter().map(nearest).collect(),
            _ => return Err(IoError::Damaged { file: file.to_owned(), message: "its values are no floating-point numbers".to_owned() }),
        };
        let [width, height] = self.size;
        if values.len() != width * height * self.channels {
            let message = format!("{} values in {width} x {height} texels of {}", values.len(), self.channels);
            return Err(IoError::Damaged { file: file.to_owned(), message });
        }
        Ok(match self.channels {
            3 => values,
            1 | 2 => values.chunks_exact(self.channels).flat_map(|texel| [texel[0]; 3]).collect(),
            _ => values.chunks_exact(self.channels).flat_map(|texel| [texel[0], texel[1], texel[2]]).collect(),
        })
    }
}

/// The nearest number of 32 bits; what is finite stays finite.
#[expect(clippy::cast_possible_truncation, reason = "rounds")]
fn nearest(value: f64) -> f32 {
    if value.is_finite() { value.clamp(f64::from(f32::MIN), f64::from(f32::MAX)) as f32 } else { value as f32 }
}

fn failure(file: &str, bytes: &[u8], error: TiffError) -> IoError {
    let file = file.to_owned();
    match error {
        TiffError::IoError(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => IoError::Truncated { file, bytes: bytes.len() },
        TiffError::UnsupportedError(found) => IoError::Unsupported { file, found: format!("TIFF: {found}") },
        other => IoError::Damaged { file, message: other.to_string() },
    }
}
