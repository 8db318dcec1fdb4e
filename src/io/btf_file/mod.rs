//! `.btf` containers, as the University of Bonn publishes its BTFs in (UBO2014 among them): FMF, DFMF, PVF and BDI.
//!
//! Little-endian, no padding. The signature at the start says the kind; where two fit, the longer holds. What follows the last value does
//! not count. Values are linear, the top row comes first, and samples are numbered `light + number of lights · view`.
//!
//! What a header counts is compared with the file's length before anything is allocated for it, and sizes are multiplied with checks in 64
//! bits. Values are read where they lie, by position: a file that is mapped into memory instead would end the process (SIGBUS) if it shrank
//! or its disk failed meanwhile, where a read gives an error; and a mapping needs `unsafe`.
//!
//! FMF, DFMF and PVF are reconstructed from factors. Where that comes out below 0 it is the factorisation's error and no measurement, so it
//! is held at 0 and takes part; a BDI's values are measurements and come as they are, negative ones, too. What exceeds the largest half,
//! 65504, is held at it.

mod bdi;
mod bytes;
mod color;
mod dfmf;
mod error;
mod factored;
mod fmf;
mod header;
mod pvf;
mod scalar;
mod share;

use std::{ops::Range, path::Path, sync::Arc};

use half::f16;

use self::{
    bytes::{Container, Header},
    header::Directions,
};
use super::{IoError, ReadOptions, Source, archive::first_bytes};
use crate::data::{Block, Btf, Encoding, Pair, RowOrder, Transfer};

pub use error::BtfFileError;

/// A container's kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Dfmf,
    Fmf { extended: bool },
    Pvf,
    Bdi,
}

/// Signatures, kinds, and whether rotations follow the size; of two that fit the longer comes first.
const SIGNATURES: [(&[u8], Kind, bool); 9] = [
    (b"!DFMF08FCR", Kind::Dfmf, true),
    (b"!DFMF08FC", Kind::Dfmf, false),
    (b"!FMF12FCER", Kind::Fmf { extended: true }, true),
    (b"!FMF12FCE", Kind::Fmf { extended: true }, false),
    (b"!FMF06FCR", Kind::Fmf { extended: false }, true),
    (b"!FMF06FC", Kind::Fmf { extended: false }, false),
    (b"!PVF06FCR", Kind::Pvf, true),
    (b"!PVF06FC", Kind::Pvf, false),
    (b"!BDIF06R2!", Kind::Bdi, true),
];

/// Bytes of the longest signature.
const LONGEST: u8 = 10;

/// The signature that bytes start with.
fn signature(start: &[u8]) -> Option<&'static (&'static [u8], Kind, bool)> {
    SIGNATURES.iter().find(|(signature, ..)| start.starts_with(signature))
}

/// What a header says of the BTF.
#[derive(Debug)]
struct Described {
    encoding: Encoding,
    directions: Directions,
    /// Columns and rows.
    size: [u32; 2],
}

impl Described {
    /// META, BIDIR, size and, if `rotated`, rotations.
    fn read(header: &mut Header<'_>, rotated: bool) -> Result<Self, BtfFileError> {
        let (encoding, directions, size) = (header::meta(header)?, header::directions(header)?, header::size(header)?);
        if rotated {
            header::rotations(header)?;
        }
        Ok(Self { encoding, directions, size })
    }

    fn samples(&self) -> u64 {
        self.directions.counts.map(u64::from).iter().product()
    }

    fn texels(&self) -> u64 {
        self.size.map(u64::from).iter().product()
    }
}

/// Where the values are.
#[derive(Debug)]
enum Layout {
    Factored(factored::Factored),
    Dump(bdi::Dump),
}

/// A `.btf` container.
#[derive(Debug)]
pub(super) struct BtfFile {
    container: Container,
    btf: Btf,
    layout: Layout,
}

impl BtfFile {
    /// Whether a file starts with a container's signature, or is called `.btf`.
    pub(super) fn is_one(path: &Path) -> bool {
        let named = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("btf"));
        path.is_file() && (named || Self::has_signature(path))
    }

    /// Whether a file starts with a container's signature.
    pub(super) fn has_signature(path: &Path) -> bool {
        path.is_file()
            && Container::open(path).is_ok_and(|container| container.start(LONGEST).is_ok_and(|start| signature(&start).is_some()))
    }

    /// Reads a file's header.
    pub(super) fn open(path: &Path, options: &ReadOptions) -> Result<Self, IoError> {
        let name = path.file_stem().map_or_else(|| path.display().to_string(), |name| name.to_string_lossy().into_owned());
        Self::read(Container::open(path)?, name, options)
    }

    /// Reads the header of a file that is in memory.
    pub(super) fn from_bytes(name: &str, bytes: Arc<[u8]>, options: &ReadOptions) -> Result<Self, IoError> {
        Self::read(Container::from_bytes(name, bytes), name.to_owned(), options)
    }

    fn read(container: Container, name: String, options: &ReadOptions) -> Result<Self, IoError> {
        let start = container.start(LONGEST)?;
        let Some(&(signature, kind, rotated)) = signature(&start) else {
            let expected = SIGNATURES.map(|(signature, ..)| signature.escape_ascii().to_string()).join(", ");
            return Err(BtfFileError::Signature { file: container.file().to_owned(), expected, found: first_bytes(&start) }.into());
        };
        let mut header = Header::new(&container, signature.len());
        let factored = |(described, factored)| (described, Layout::Factored(factored));
        let (described, layout) = match kind {
            Kind::Dfmf => dfmf::read(&mut header, rotated).map(factored),
            Kind::Fmf { extended } => fmf::read(&mut header, rotated, extended).map(factored),
            Kind::Pvf => pvf::read(&mut header, rotated).map(factored),
            Kind::Bdi => bdi::read(&mut header).map(|(described, dump)| (described, Layout::Dump(dump))),
        }?;
        let size = described.size.map(|side| side as usize);
        let Directions { views, lights, .. } = described.directions;
        let pairs = (0..views.len()).flat_map(|view| (0..lights.len()).map(move |light| Pair { view, light })).collect();
        let btf = Btf::new(name, size, views, lights, pairs, options.encoding(described.encoding))?;
        Ok(Self { container, btf, layout })
    }
}

impl Source for BtfFile {
    fn btf(&self) -> &Btf {
        &self.btf
    }

    fn chunk(&self) -> Option<[usize; 2]> {
        let width = self.btf.size()[0];
        Some(match &self.layout {
            Layout::Factored(factored) => factored.chunk(width),
            Layout::Dump(dump) => dump.chunk(width),
        })
    }

    fn read(&self, samples: &[usize], block: Block, radiance: &mut [f16], done: &(dyn Fn(usize) + Sync)) -> Result<(), IoError> {
        let there = samples.is_sorted_by(|a, b| a < b) && samples.last().is_none_or(|&last| last < self.btf.pairs().len());
        assert!(there && block.is_within(self.btf.size()), "samples and block of the source");
        assert!(radiance.len() == 3 * samples.len() * block.texels(), "room for the block's radiance");
        if samples.is_empty() {
            return Ok(());
        }
        match &self.layout {
            Layout::Factored(factored) => factored.read(&self.container, &self.btf, samples, block, radiance, done)?,
            Layout::Dump(dump) => dump.read(&self.container, &self.btf, samples, block, radiance, done)?,
        }
        Ok(())
    }

    fn fingerprint(&self) -> String {
        self.container.fingerprint().to_owned()
    }
}

/// Texels as they are stored.
#[derive(Debug, Clone, Copy)]
struct Plane {
    width: usize,
    height: usize,
    rows: RowOrder,
}

/// Texels of a row that are stored one after the other.
#[derive(Debug, Clone, Copy)]
struct Run {
    /// The first of them, as stored.
    texel: usize,
    /// How many.
    texels: usize,
    /// The first of them, counted from the start of what was asked for.
    at: usize,
}

impl Plane {
    fn of(btf: &Btf) -> Self {
        let [width, height] = btf.size();
        Self { width, height, rows: btf.encoding().rows }
    }

    /// `range` of the block's texels, row by row.
    fn runs(self, block: Block, range: Range<usize>) -> impl Iterator<Item = Run> {
        (range.start / block.width..range.end.div_ceil(block.width)).map(move |row| {
            let start = range.start.max(row * block.width);
            let end = range.end.min((row + 1) * block.width);
            let stored = match self.rows {
                RowOrder::TopDown => block.row + row,
                RowOrder::BottomUp => self.height - 1 - block.row - row,
            };
            Run { texel: stored * self.width + block.column + start % block.width, texels: end - start, at: start - range.start }
        })
    }
}

/// From stored values of one sample to radiance.
struct Radiances<'a> {
    encoding: &'a Encoding,
    /// Whether stored values are linear.
    linear: bool,
    factor: f32,
}

impl<'a> Radiances<'a> {
    fn of(btf: &'a Btf, sample: usize) -> Self {
        let encoding = btf.encoding();
        #[expect(clippy::cast_possible_truncation, reason = "24 bits are more than a half keeps")]
        let factor = encoding.factor(btf.directions(sample).1) as f32;
        Self { encoding, linear: encoding.transfer == Transfer::Linear, factor }
    }

    /// Radiance of a stored value, held at what a half can hold; what is finite stays finite.
    fn held(&self, stored: f32) -> f32 {
        #[expect(clippy::cast_possible_truncation, reason = "24 bits are more than a half keeps")]
        let linear = if self.linear { stored } else { self.encoding.linear(f64::from(stored)) as f32 };
        let (radiance, most) = (linear * self.factor, f16::MAX.to_f32());
        if stored.is_finite() && radiance.abs() > most { most.copysign(radiance) } else { radiance }
    }

    /// Radiance of a value that was measured. What is negative stays negative, however small, since that marks it as no radiance.
    fn of_measured(&self, stored: f16) -> f16 {
        let radiance = self.held(stored.to_f32());
        match f16::from_f32(radiance) {
            half if half != f16::ZERO => half,
            _ if radiance < 0.0 => -f16::MIN_POSITIVE_SUBNORMAL,
            _ => f16::ZERO,
        }
    }

    /// Radiance of a value that was reconstructed.
    fn of_reconstructed(&self, stored: f32) -> f32 {
        let radiance = self.held(stored);
        if radiance.is_finite() && radiance <= 0.0 { 0.0 } else { radiance }
    }
}
