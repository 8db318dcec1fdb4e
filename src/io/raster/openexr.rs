//! OpenEXR: RGB, gray, CIE XYZ and spectra, told apart by the names of the channels.
//!
//! | channels | read as |
//! |---|---|
//! | wavelengths in nm, such as `450nm`, `450.0`, `w450nm`, `S0.450,5nm`, `T.450nm` | a spectrum, reduced as [`spectrum`] says |
//! | `X`, `Y`, `Z` | CIE XYZ with the white of D65 |
//! | `R`, `G`, `B` | linear sRGB |
//! | `Y` alone | gray |
//!
//! The first row that matches counts (spectral files carry an RGB preview), other channels do not. Spectra and XYZ are colours that sRGB
//! may not hold: a negative R, G or B of such a colour becomes 0. That is a rule for colours, not for measurements: where a channel of the
//! file is negative, infinite or not a number, R, G and B are all what it is.

use std::{collections::HashMap, io::Cursor, sync::LazyLock};

use exr::{
    block::{
        lines::LineRef,
        reader::{ChunksReader, Reader},
    },
    error::Error,
    math::Vec2,
    meta::{
        attribute::{ChannelDescription, SampleType},
        header::Header,
    },
};
use half::f16;
use regex::Regex;

use crate::{
    io::IoError,
    model::{color::linear_from_xyz, spectrum},
};

/// The most that the pixels of one image may take: 8192 x 8192 texels of four channels of 32 bits.
const MAX_BYTES: usize = 1 << 30;

/// Channels that an error lists.
const LISTED: usize = 8;

/// A decoder that has read the header.
pub(super) struct OpenExr<'a> {
    reader: Reader<Cursor<&'a [u8]>>,
    channels: Channels,
    /// Columns and rows.
    pub size: [usize; 2],
}

/// What R, G and B are made of; channels by index.
#[derive(Debug, PartialEq)]
enum Channels {
    /// One channel each.
    Copied([usize; 3]),
    /// Each is a sum of these channels, so many times.
    Mixed(HashMap<usize, [f32; 3]>),
}

impl<'a> OpenExr<'a> {
    /// Reads the header.
    pub(super) fn open(file: &str, bytes: &'a [u8]) -> Result<Self, IoError> {
        let reader = exr::block::read(Cursor::new(bytes), false).map_err(|error| failure(file, bytes, error))?;
        let unsupported = |found: String| IoError::Unsupported { file: file.to_owned(), found };
        let Some(header) = reader.headers().first() else { return Err(unsupported("OpenEXR without an image".to_owned())) };
        if header.deep {
            return Err(unsupported("OpenEXR with deep data".to_owned()));
        }
        if header.channels.list.iter().any(|channel| channel.sampling != Vec2(1, 1)) {
            return Err(unsupported("OpenEXR with channels of fewer samples than pixels".to_owned()));
        }
        let Vec2(width, height) = header.layer_size;
        let found = width.saturating_mul(height).saturating_mul(header.channels.bytes_per_pixel);
        if found > MAX_BYTES {
            return Err(IoError::TooManyBytes { file: file.to_owned(), found: found as u64, limit: MAX_BYTES as u64 });
        }
        let channels = channels(file, header)?;
        Ok(Self { reader, channels, size: [width, height] })
    }

    /// RGB of all texels.
    pub(super) fn decode(self, file: &str, bytes: &[u8]) -> Result<Vec<f32>, IoError> {
        let failed = |error| failure(file, bytes, error);
        let damaged = |message: &str| IoError::Damaged { file: file.to_owned(), message: message.to_owned() };
        let [width, height] = self.size;
        let mut image = Texels::new(self.channels, width * height);
        let mut blocks = self.reader.all_chunks(false).map_err(failed)?.sequential_decompressor(false);
        while let Some(block) = blocks.decompress_next_block() {
            let block = block.map_err(failed)?;
            if block.index.layer != 0 || block.index.level != Vec2(0, 0) {
                continue;
            }
            let channels = &blocks.meta_data().headers[0].channels;
            for line in block.lines(channels) {
                let Vec2(column, row) = line.location.position;
                if row >= height || column >= width || line.location.sample_count > width - column {
                    return Err(damaged("a part of its pixels lies outside"));
                }
                image.take(&line, &channels.list[line.location.channel], row * width + column).map_err(failed)?;
            }
        }
        image.finish().ok_or_else(|| damaged("a part of its pixels is missing"))
    }
}

/// RGB in the making.
struct Texels {
    channels: Channels,
    values: Vec<f32>,
    /// Channels taken of each texel.
    taken: Vec<u16>,
    /// What is no radiance among the channels of a mixed texel.
    unmixed: HashMap<usize, f32>,
}

impl Texels {
    fn new(channels: Channels, texels: usize) -> Self {
        Self { channels, values: vec![0.0; 3 * texels], taken: vec![0; texels], unmixed: HashMap::new() }
    }

    /// Takes the values of a channel that start at texel `start`.
    fn take(&mut self, line: &LineRef<'_>, channel: &ChannelDescription, start: usize) -> Result<(), Error> {
        let index = line.location.channel;
        match channel.sample_type {
            SampleType::F16 => self.add(index, start, line.read_samples::<f16>().map(|value| value.map(f32::from))),
            SampleType::F32 => self.add(index, start, line.read_samples::<f32>()),
            SampleType::U32 => self.add(index, start, line.read_samples::<u32>().map(|value| value.map(|value| value as f32))),
        }
    }

    fn add(&mut self, channel: usize, start: usize, values: impl Iterator<Item = Result<f32, Error>>) -> Result<(), Error> {
        match &self.channels {
            Channels::Copied(sources) => {
                for (texel, value) in (start..).zip(values) {
                    let value = value?;
                    for (target, source) in sources.iter().enumerate() {
                        if *source == channel {
                            self.values[3 * texel + target] = value;
                            self.taken[texel] = self.taken[texel].saturating_add(1);
                        }
                    }
                }
            }
            Channels::Mixed(weights) => {
                let Some(weights) = weights.get(&channel) else { return Ok(()) };
                for (texel, value) in (start..).zip(values) {
                    let value = value?;
                    if !(value >= 0.0 && value.is_finite()) {
                        self.unmixed.insert(texel, value);
                    }
                    for (target, weight) in weights.iter().enumerate() {
                        self.values[3 * texel + target] += weight * value;
                    }
                    self.taken[texel] = self.taken[texel].saturating_add(1);
                }
            }
        }
        Ok(())
    }

    /// All texels, if all of them are there.
    fn finish(mut self) -> Option<Vec<f32>> {
        let channels = match &self.channels {
            Channels::Copied(_) => 3,
            Channels::Mixed(weights) => {
                self.values.iter_mut().for_each(|value| *value = value.clamp(0.0, f32::MAX));
                for (texel, &value) in &self.unmixed {
                    self.values[3 * texel..3 * texel + 3].fill(value);
                }
                weights.len()
            }
        };
        self.taken.iter().all(|&taken| usize::from(taken) == channels).then_some(self.values)
    }
}

/// The channels that R, G and B are made of.
fn channels(file: &str, header: &Header) -> Result<Channels, IoError> {
    let names: Vec<String> = header.channels.list.iter().map(|channel| channel.name.to_string()).collect();
    let unknown = || {
        let mut found = names.iter().take(LISTED).cloned().collect::<Vec<_>>().join(", ");
        if names.len() > LISTED {
            found.push_str(", …");
        }
        IoError::Channels { file: file.to_owned(), found }
    };
    let mut spectrum: Vec<(f64, usize)> = names.iter().enumerate().filter_map(|(index, name)| Some((wavelength(name)?, index))).collect();
    if !spectrum.is_empty() {
        spectrum.sort_by(|a, b| a.0.total_cmp(&b.0));
        let wavelengths: Vec<f64> = spectrum.iter().map(|(wavelength, _)| *wavelength).collect();
        if wavelengths.windows(2).any(|pair| pair[0] == pair[1]) || spectrum.len() > usize::from(u16::MAX) {
            return Err(unknown());
        }
        let weights = spectrum::rgb_weights(&wavelengths);
        return Ok(Channels::Mixed(spectrum.iter().zip(weights).map(|((_, index), weight)| (*index, weight.map(single))).collect()));
    }
    let index = |name: &str| names.iter().position(|found| found == name);
    match [index("X"), index("Y"), index("Z"), index("R"), index("G"), index("B")] {
        [Some(x), Some(y), Some(z), ..] => {
            let units = [(x, [1.0, 0.0, 0.0]), (y, [0.0, 1.0, 0.0]), (z, [0.0, 0.0, 1.0])];
            Ok(Channels::Mixed(units.map(|(index, unit)| (index, linear_from_xyz(unit).map(single))).into()))
        }
        [.., Some(r), Some(g), Some(b)] => Ok(Channels::Copied([r, g, b])),
        // With differences of colour beside it, Y is not all there is.
        [None, Some(y), None, None, None, None] if index("RY").or(index("BY")).is_none() => Ok(Channels::Copied([y; 3])),
        _ => Err(unknown()),
    }
}

#[expect(clippy::cast_possible_truncation, reason = "rounds")]
fn single(weight: f64) -> f32 {
    weight as f32
}

/// The wavelength in nm that a channel's name says, as Bonn writes it and as Fichet, Pacanowski and Wilkie 2021 do.
fn wavelength(name: &str) -> Option<f64> {
    static NAME: LazyLock<Regex> =
        LazyLock::new(|| Regex::new(r"^(?i:s0\.|t\.|w)?([0-9]{3,4}(?:[.,][0-9]+)?)(?i: ?nm)?$").expect("the pattern is a constant"));
    NAME.captures(name)?[1].replace(',', ".").parse().ok()
}

fn failure(file: &str, bytes: &[u8], error: Error) -> IoError {
    let file = file.to_owned();
    match error {
        Error::Io(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => IoError::Truncated { file, bytes: bytes.len() },
        Error::NotSupported(found) => IoError::Unsupported { file, found: format!("OpenEXR: {found}") },
        other => IoError::Damaged { file, message: other.to_string() },
    }
}
