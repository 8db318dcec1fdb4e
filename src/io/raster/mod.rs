//! Encoded images to texels.
//!
//! The format is told by the content, not the extension. Sizes are judged before anything is allocated for them.

mod drawing;
mod float_tiff;
mod jpeg;
mod openexr;
mod radiance_hdr;

use std::{
    io::Cursor,
    panic::{AssertUnwindSafe, catch_unwind},
};

use image::{ColorType, DynamicImage, ImageDecoder, ImageError, ImageFormat, ImageReader};

pub(super) use drawing::drawing;

use super::{IoError, archive::first_bytes};
use crate::data::Transfer;

/// The largest image that is read: 8192 x 8192 texels.
const MAX_TEXELS: usize = 1 << 26;

/// What an encoded image's header says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Header {
    /// Columns and rows.
    pub size: [usize; 2],
    /// What its values are unless somebody knows better: sRGB codes if they are integers, linear if they are floating-point numbers.
    pub transfer: Transfer,
}

/// A decoded image as stored, the top row first, three values a texel.
#[derive(Debug)]
pub(super) enum Picture {
    /// Codes of 8 bits.
    Bytes(Vec<u8>),
    /// Codes of 16 bits.
    Words(Vec<u16>),
    /// Floating-point numbers.
    Floats(Vec<f32>),
}

impl Picture {
    /// As [`Header::transfer`].
    pub(super) fn transfer(&self) -> Transfer {
        if matches!(self, Self::Floats(_)) { Transfer::Linear } else { Transfer::Srgb }
    }
}

/// Reads the header of an encoded image.
pub(super) fn header(file: &str, bytes: &[u8]) -> Result<Header, IoError> {
    guarded(file, || read_header(file, bytes))
}

/// The texels of an encoded image of `expected` columns and rows. Nothing is allocated for another size.
pub(super) fn decode(file: &str, bytes: &[u8], expected: [usize; 2]) -> Result<Picture, IoError> {
    guarded(file, || read_texels(file, bytes, expected))
}

/// Calls a decoder. Those of the libraries panic on some damaged files (OpenEXR's on damaged B44 and PXR24); that is damage like other.
fn guarded<T>(file: &str, decode: impl FnOnce() -> Result<T, IoError>) -> Result<T, IoError> {
    let damaged = |_| Err(IoError::Damaged { file: file.to_owned(), message: "its decoder gave up".to_owned() });
    // Nothing that the decoder leaves half done is used afterwards.
    catch_unwind(AssertUnwindSafe(decode)).unwrap_or_else(damaged)
}

fn read_header(file: &str, bytes: &[u8]) -> Result<Header, IoError> {
    let (integers, floats) = (Transfer::Srgb, Transfer::Linear);
    let (size, transfer) = match Decoder::open(file, bytes)? {
        Decoder::Jpeg(_, size) => (size, integers),
        Decoder::Library(decoder) => (library_size(&decoder), integers),
        Decoder::FloatTiff(tiff) => (tiff.size, floats),
        Decoder::RadianceHdr(hdr) => (hdr.size, floats),
        Decoder::OpenExr(exr) => (exr.size, floats),
    };
    let [width, height] = size;
    if width.saturating_mul(height) > MAX_TEXELS {
        Err(IoError::TooManyTexels { file: file.to_owned(), width, height, limit: MAX_TEXELS })
    } else {
        Ok(Header { size, transfer })
    }
}

fn read_texels(file: &str, bytes: &[u8], expected: [usize; 2]) -> Result<Picture, IoError> {
    let fits = |found: [usize; 2]| if found == expected { Ok(()) } else { Err(IoError::Size { file: file.to_owned(), found, expected }) };
    match Decoder::open(file, bytes)? {
        Decoder::Jpeg(decoder, size) => fits(size).and_then(|()| jpeg::decode(file, bytes, decoder)).map(Picture::Bytes),
        Decoder::FloatTiff(tiff) => fits(tiff.size).and_then(|()| tiff.decode(file, bytes)).map(Picture::Floats),
        Decoder::RadianceHdr(hdr) => fits(hdr.size).and_then(|()| hdr.decode(file, bytes)).map(Picture::Floats),
        Decoder::OpenExr(exr) => fits(exr.size).and_then(|()| exr.decode(file, bytes)).map(Picture::Floats),
        Decoder::Library(decoder) => {
            fits(library_size(&decoder))?;
            let is_bytes = decoder.color_type().bytes_per_pixel() == decoder.color_type().channel_count();
            let image = DynamicImage::from_decoder(decoder).map_err(|error| library_error(file, bytes, &error))?;
            Ok(if is_bytes { Picture::Bytes(image.into_rgb8().into_raw()) } else { Picture::Words(image.into_rgb16().into_raw()) })
        }
    }
}

/// A decoder that has read an image's header.
#[expect(clippy::large_enum_variant, reason = "there is one at a time, for as long as an image is decoded")]
enum Decoder<'a> {
    Jpeg(jpeg::Jpeg<'a>, [usize; 2]),
    /// PNG, BMP and TIFF of 8 or 16 bits.
    Library(Box<dyn ImageDecoder + 'a>),
    FloatTiff(float_tiff::FloatTiff<'a>),
    RadianceHdr(radiance_hdr::RadianceHdr<'a>),
    OpenExr(openexr::OpenExr<'a>),
}

impl<'a> Decoder<'a> {
    fn open(file: &str, bytes: &'a [u8]) -> Result<Self, IoError> {
        if bytes.starts_with(radiance_hdr::SIGNATURE) {
            return radiance_hdr::RadianceHdr::open(file, bytes).map(Self::RadianceHdr);
        }
        match image::guess_format(bytes) {
            Ok(ImageFormat::Jpeg) => jpeg::open(file, bytes).map(|(decoder, size)| Self::Jpeg(decoder, size)),
            Ok(ImageFormat::OpenExr) => openexr::OpenExr::open(file, bytes).map(Self::OpenExr),
            Ok(ImageFormat::Tiff) => match float_tiff::FloatTiff::open(file, bytes)? {
                Some(tiff) => Ok(Self::FloatTiff(tiff)),
                None => library(file, bytes, ImageFormat::Tiff).map(Self::Library),
            },
            Ok(format @ (ImageFormat::Png | ImageFormat::Bmp)) => library(file, bytes, format).map(Self::Library),
            Ok(other) => Err(IoError::Unsupported { file: file.to_owned(), found: format!("{other:?}") }),
            Err(_) => Err(IoError::NotAnImage { file: file.to_owned(), found: first_bytes(bytes) }),
        }
    }
}

fn library<'a>(file: &str, bytes: &'a [u8], format: ImageFormat) -> Result<Box<dyn ImageDecoder + 'a>, IoError> {
    let decoder =
        ImageReader::with_format(Cursor::new(bytes), format).into_decoder().map_err(|error| library_error(file, bytes, &error))?;
    match decoder.color_type() {
        ColorType::L8 | ColorType::La8 | ColorType::Rgb8 | ColorType::Rgba8 => Ok(Box::new(decoder)),
        ColorType::L16 | ColorType::La16 | ColorType::Rgb16 | ColorType::Rgba16 => Ok(Box::new(decoder)),
        other => Err(IoError::Unsupported { file: file.to_owned(), found: format!("{format:?} of {other:?} pixels") }),
    }
}

fn library_size(decoder: &dyn ImageDecoder) -> [usize; 2] {
    let (width, height) = decoder.dimensions();
    [width as usize, height as usize]
}

fn library_error(file: &str, bytes: &[u8], error: &ImageError) -> IoError {
    let file = file.to_owned();
    match error {
        ImageError::IoError(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => IoError::Truncated { file, bytes: bytes.len() },
        ImageError::Unsupported(found) => IoError::Unsupported { file, found: found.to_string() },
        other => IoError::Damaged { file, message: other.to_string() },
    }
}
