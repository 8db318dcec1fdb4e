//! Encoded 8-bit images to texels.
//!
//! The format is told by the content, not the extension. A measurement must not contain guessed values, so JPEGs are
//! decoded strictly: by default the decoder fills what is missing or damaged with gray and reports success.

use std::io::Cursor;

use image::{ColorType, DynamicImage, ImageDecoder, ImageError, ImageFormat, ImageReader};
use zune_jpeg::{
    JpegDecoder,
    errors::DecodeErrors,
    zune_core::{bytestream::ZCursor, colorspace::ColorSpace, options::DecoderOptions},
};

use super::{IoError, archive::first_bytes};

/// The largest image that is read: 8192 x 8192 texels, 256 MiB as RGBA.
const MAX_TEXELS: usize = 1 << 26;

/// Columns and rows of an encoded image, from its header.
pub(super) fn size(file: &str, bytes: &[u8]) -> Result<[usize; 2], IoError> {
    let size = match format(file, bytes)? {
        ImageFormat::Jpeg => jpeg(file, bytes)?.1,
        other => raster_size(&raster(file, bytes, other)?),
    };
    let [width, height] = size;
    if width.saturating_mul(height) > MAX_TEXELS {
        Err(IoError::TooManyTexels { file: file.to_owned(), width, height, limit: MAX_TEXELS })
    } else {
        Ok(size)
    }
}

/// The texels of an encoded image of `expected` columns and rows, alpha 255. Nothing is allocated for another size.
pub(super) fn decode(file: &str, bytes: &[u8], expected: [usize; 2]) -> Result<Vec<[u8; 4]>, IoError> {
    let fits = |found: [usize; 2]| if found == expected { Ok(()) } else { Err(IoError::Size { file: file.to_owned(), found, expected }) };
    let mut texels = match format(file, bytes)? {
        ImageFormat::Jpeg => {
            let (mut decoder, found) = jpeg(file, bytes)?;
            fits(found)?;
            if !jpeg_ends(bytes) {
                return Err(IoError::Truncated { file: file.to_owned(), bytes: bytes.len() });
            }
            decoder.decode().map_err(|error| jpeg_error(file, bytes, &error))?
        }
        other => {
            let decoder = raster(file, bytes, other)?;
            fits(raster_size(&decoder))?;
            let image = DynamicImage::from_decoder(decoder).map_err(|error| raster_error(file, bytes, &error))?;
            image.into_rgba8().into_raw()
        }
    };
    texels.iter_mut().skip(3).step_by(4).for_each(|alpha| *alpha = 255);
    Ok(texels.as_chunks().0.to_vec())
}

fn format(file: &str, bytes: &[u8]) -> Result<ImageFormat, IoError> {
    match image::guess_format(bytes) {
        Ok(format @ (ImageFormat::Jpeg | ImageFormat::Png | ImageFormat::Bmp | ImageFormat::Tiff)) => Ok(format),
        Ok(other) => Err(IoError::Unsupported { file: file.to_owned(), found: format!("{other:?}") }),
        Err(_) => Err(IoError::NotAnImage { file: file.to_owned(), found: first_bytes(bytes) }),
    }
}

fn jpeg<'a>(file: &str, bytes: &'a [u8]) -> Result<(JpegDecoder<ZCursor<&'a [u8]>>, [usize; 2]), IoError> {
    let options = DecoderOptions::default().set_strict_mode(true).jpeg_set_out_colorspace(ColorSpace::RGBA);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(|error| jpeg_error(file, bytes, &error))?;
    let (width, height) = decoder.dimensions().unwrap_or_default();
    Ok((decoder, [width, height]))
}

fn jpeg_error(file: &str, bytes: &[u8], error: &DecodeErrors) -> IoError {
    let file = file.to_owned();
    if jpeg_ends(bytes) { IoError::Damaged { file, message: error.to_string() } } else { IoError::Truncated { file, bytes: bytes.len() } }
}

/// Whether the segments of a JPEG lead to its end marker (ITU T.81 B.1.1). The strict decoder asks for it only where
/// entropy-coded data run out before the last row of blocks. End markers inside a segment, as of a preview, do not count.
fn jpeg_ends(bytes: &[u8]) -> bool {
    let mut rest = bytes;
    while let Some(start) = rest.windows(2).position(|pair| pair[0] == 0xff && !matches!(pair[1], 0x00 | 0xff)) {
        let marker = rest[start + 1];
        rest = &rest[start + 2..];
        match marker {
            // End of image.
            0xd9 => return true,
            // Markers without a segment: start of image, restarts, temporary.
            0xd0..=0xd8 | 0x01 => {}
            // After the segment of a scan its data follow, in which FF is written FF 00: they are no markers.
            _ => match rest.first_chunk().and_then(|&length| rest.get(usize::from(u16::from_be_bytes(length))..)) {
                Some(after) => rest = after,
                None => return false,
            },
        }
    }
    false
}

fn raster<'a>(file: &str, bytes: &'a [u8], format: ImageFormat) -> Result<impl ImageDecoder + 'a, IoError> {
    let decoder = ImageReader::with_format(Cursor::new(bytes), format).into_decoder().map_err(|error| raster_error(file, bytes, &error))?;
    match decoder.color_type() {
        ColorType::L8 | ColorType::La8 | ColorType::Rgb8 | ColorType::Rgba8 => Ok(decoder),
        other => Err(IoError::Unsupported { file: file.to_owned(), found: format!("{format:?} of {other:?} pixels") }),
    }
}

fn raster_size(decoder: &impl ImageDecoder) -> [usize; 2] {
    let (width, height) = decoder.dimensions();
    [width as usize, height as usize]
}

fn raster_error(file: &str, bytes: &[u8], error: &ImageError) -> IoError {
    let file = file.to_owned();
    match error {
        ImageError::IoError(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => IoError::Truncated { file, bytes: bytes.len() },
        other => IoError::Damaged { file, message: other.to_string() },
    }
}
