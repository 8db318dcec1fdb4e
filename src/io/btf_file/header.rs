//! What the kinds of containers start with: META (who measured what, and in which units), BIDIR (the directions) and the size.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::{BtfFileError, bytes::Header};
use crate::data::{Direction, Encoding, RowOrder, Transfer};

/// Versions of META that are known.
const VERSIONS: std::ops::RangeInclusive<u32> = 1..=4;

/// Bytes of a channel's name that are looked at.
const NAME: u64 = 64;

/// What there is without META, and as META of version 1 has it: linear values, the top row first, and no word about the cosine. Version 2
/// can say that the cosine is within, so what is older than that has it not; Bonn's own reader takes it so, too.
pub(super) const WITHOUT_META: Encoding =
    Encoding { transfer: Transfer::Linear, includes_cosine: false, rows: RowOrder::TopDown, scale: 1.0, texels_per_mm: None };

/// The directions of a container: every view has every light.
#[derive(Debug)]
pub(super) struct Directions {
    pub(super) views: Vec<Direction>,
    pub(super) lights: Vec<Direction>,
    /// Number of views and of lights, as stored.
    pub(super) counts: [u32; 2],
}

/// Reads META: `u32` size, counted from itself; `u32` version; three texts of 80 bytes; `f32` pixels per mm; `f32[3]` scale of RGB, which
/// published readers leave alone, and so does this one; from version 2 on `u32` whether the cosine is within; from version 3 on a text; from
/// version 4 on the names of the channels, a `u32` count and a text each. A text is its `u32` length and its bytes.
pub(super) fn meta(header: &mut Header<'_>) -> Result<Encoding, BtfFileError> {
    let start = header.offset();
    let size = header.u32("size of META")?;
    let at = header.offset();
    let version = header.u32("version of META")?;
    if !VERSIONS.contains(&version) {
        return Err(header.unsupported(at, "the version of META", "1 to 4", version));
    }
    header.pass("texts of META", &[3, 80])?;
    let texels_per_mm = header.f32("pixels per mm")?;
    header.pass("scale of RGB", &[12])?;
    let includes_cosine = version > 1 && header.u32("cosine flag")? != 0;
    if version > 2 {
        let length = header.u32("length of the XML text")?;
        header.pass("XML text", &[u64::from(length)])?;
    }
    if version > 3 {
        channels(header)?;
    }
    let found = header.offset() - start;
    if u64::from(size) != found {
        return Err(header.unexpected(start, "size of META", format_args!("{found} bytes, which its fields have"), size));
    }
    let texels_per_mm = Some(f64::from(texels_per_mm)).filter(|&texels| texels.is_finite() && texels > 0.0);
    Ok(Encoding { includes_cosine, texels_per_mm, ..WITHOUT_META })
}

/// Reads the names of the channels, which must be R, G and B.
fn channels(header: &mut Header<'_>) -> Result<(), BtfFileError> {
    let at = header.offset();
    let count = header.u32("number of channels")?;
    let mut names = Vec::new();
    for _ in 0..count.min(3) {
        let length = u64::from(header.u32("length of a channel's name")?);
        let start = header.pass("a channel's name", &[length])?;
        let mut name = vec![0; header.count(start, "a channel's name", &[length.min(NAME)])?];
        header.container().read(&mut name, start)?;
        names.push(String::from_utf8_lossy(&name).trim_matches(['\0', ' ']).to_owned());
    }
    if count == 3 && names.iter().zip(["R", "G", "B"]).all(|(name, expected)| name.eq_ignore_ascii_case(expected)) {
        return Ok(());
    }
    let names = names.iter().map(|name| format!("\"{}\"", name.escape_debug())).collect::<Vec<_>>().join(", ");
    let found = format!("{count} channels, {names}{}", if count > 3 { ", …" } else { "" });
    Err(header.unsupported(at, "the list of channels", "R, G, B", found))
}

/// Reads BIDIR: `u32` number of views; for each view θ and φ (`f32`, radians), `u32` number of lights, θ and φ of each light. All views must
/// have the same lights.
pub(super) fn directions(header: &mut Header<'_>) -> Result<Directions, BtfFileError> {
    let count = header.positive("number of views")?;
    let (mut views, mut lights) = (Vec::new(), Vec::new());
    let mut first = Vec::new();
    for view in 0..u64::from(count) {
        let at = header.offset();
        let direction = header.bytes("direction of a view", 8)?;
        views.push(self::direction(header, at, "view", view, &direction)?);
        let at = header.offset();
        let number = header.positive("number of lights")?;
        let start = header.pass("directions of the lights", &[u64::from(number), 8])?;
        let mut list = vec![0; header.count(start, "directions of the lights", &[u64::from(number), 8])?];
        header.container().read(&mut list, start)?;
        if view == 0 {
            for (light, direction) in list.chunks_exact(8).enumerate() {
                lights.push(self::direction(header, start + 8 * light as u64, "light", light as u64, direction)?);
            }
            first = list;
        } else if list != first {
            return Err(BtfFileError::Lights { file: header.container().file().to_owned(), offset: at, view });
        }
    }
    let number = header.count(header.offset(), "directions of the lights", &[lights.len() as u64])?;
    let number = u32::try_from(number).expect("was read as one");
    Ok(Directions { views, lights, counts: [count, number] })
}

/// θ and φ in radians, φ from 0 to below one turn and 0 at the zenith.
fn direction(header: &Header<'_>, offset: u64, what: &'static str, index: u64, bytes: &[u8]) -> Result<Direction, BtfFileError> {
    let angle = |at: usize| f32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]);
    let (theta, phi) = (angle(0), angle(4));
    if (0.0..FRAC_PI_2).contains(&f64::from(theta)) && phi.is_finite() {
        let turned = f64::from(phi).rem_euclid(TAU);
        // A negative angle next to 0 rounds up to the full turn.
        let phi = if theta == 0.0 || turned >= TAU { 0.0 } else { turned };
        return Ok(Direction { theta: f64::from(theta), phi });
    }
    Err(BtfFileError::Direction { file: header.container().file().to_owned(), offset, what, index, theta, phi })
}

/// Reads `u32` columns and `u32` rows of the texel plane.
pub(super) fn size(header: &mut Header<'_>) -> Result<[u32; 2], BtfFileError> {
    Ok([header.positive("columns of the texel plane")?, header.positive("rows of the texel plane")?])
}

/// Passes the rotations of local frames: `u32` count, `f32[3][3]` each. They turn directions of a curved sample; here it is flat.
pub(super) fn rotations(header: &mut Header<'_>) -> Result<(), BtfFileError> {
    let count = header.u32("number of rotations")?;
    header.pass("rotations", &[u64::from(count), 36])?;
    Ok(())
}
