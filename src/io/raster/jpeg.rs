//! JPEG, decoded strictly.
//!
//! A measurement must not contain guessed values: by default the decoder fills what is missing or damaged with gray and reports success.
//! JPEG has no checksum: damage that leaves valid codes goes unseen.

use zune_jpeg::{
    JpegDecoder,
    errors::DecodeErrors,
    zune_core::{bytestream::ZCursor, colorspace::ColorSpace, options::DecoderOptions},
};

use crate::io::IoError;

pub(super) type Jpeg<'a> = JpegDecoder<ZCursor<&'a [u8]>>;

/// A strict decoder, its header read, and the size.
pub(super) fn open<'a>(file: &str, bytes: &'a [u8]) -> Result<(Jpeg<'a>, [usize; 2]), IoError> {
    let options = DecoderOptions::default().set_strict_mode(true).jpeg_set_out_colorspace(ColorSpace::RGB);
    // Sizes are judged by the callers, for all formats alike.
    let options = options.set_max_width(usize::MAX).set_max_height(usize::MAX);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(|fault| error(file, bytes, &fault))?;
    let (width, height) = decoder.dimensions().unwrap_or_default();
    Ok((decoder, [width, height]))
}

/// RGB codes of a decoder from [`open`].
pub(super) fn decode(file: &str, bytes: &[u8], mut decoder: Jpeg<'_>) -> Result<Vec<u8>, IoError> {
    if !ends(bytes) {
        return Err(IoError::Truncated { file: file.to_owned(), bytes: bytes.len() });
    }
    decoder.decode().map_err(|fault| error(file, bytes, &fault))
}

fn error(file: &str, bytes: &[u8], fault: &DecodeErrors) -> IoError {
    let file = file.to_owned();
    if ends(bytes) { IoError::Damaged { file, message: fault.to_string() } } else { IoError::Truncated { file, bytes: bytes.len() } }
}

/// Whether the segments of a JPEG lead to its end marker (ITU T.81 B.1.1). The strict decoder asks for it only where
/// entropy-coded data run out before the last row of blocks. End markers inside a segment, as of a preview, do not count.
fn ends(bytes: &[u8]) -> bool {
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
