//! Sources of which each sample is one image.

use std::sync::OnceLock;

use half::f16;
use rayon::prelude::*;

use super::{
    IoError, ReadOptions, Source,
    archive::Archive,
    raster::{self, Picture},
};
use crate::data::{Block, Btf, Direction, Encoding, Pair, RowOrder, Transfer, radiance_half};

/// Extensions of images.
const EXTENSIONS: [&str; 8] = ["jpg", "jpeg", "png", "bmp", "tif", "tiff", "exr", "hdr"];

/// Whether a name is an image's, by its extension, and the file is not hidden.
pub(super) fn is_image(name: &str) -> bool {
    let base = base(name);
    let extension = base.rsplit_once('.').map(|(_, extension)| extension);
    !base.starts_with('.') && extension.is_some_and(|found| EXTENSIONS.into_iter().any(|known| known.eq_ignore_ascii_case(found)))
}

/// The last part of a name.
pub(super) fn base(name: &str) -> &str {
    name.rsplit('/').next().unwrap_or(name)
}

/// What images show: one image a pair.
pub(super) struct Shown {
    pub views: Vec<Direction>,
    pub lights: Vec<Direction>,
    pub pairs: Vec<Pair>,
    /// The image of each pair, an index into [`Archive::names`].
    pub files: Vec<usize>,
    /// An image that is black where there is no material.
    pub mask: Option<usize>,
    /// The transfer of all images; `None` if that of the first one's format.
    pub transfer: Option<Transfer>,
}

/// A folder or archive of images.
#[derive(Debug)]
pub(super) struct Images {
    archive: Archive,
    btf: Btf,
    files: Vec<usize>,
    /// Whether each texel, the stored ones row by row, is part of the material; `None` if all are.
    mask: Option<Vec<bool>>,
    /// The transfer that each image's format must have; `None` if it is stated.
    transfer: Option<Transfer>,
    /// Linear values of codes of 16 bits, as soon as there are any.
    linear: OnceLock<Vec<f64>>,
}

impl Images {
    /// Reads the header of the first image, and the mask.
    pub(super) fn open(archive: Archive, shown: Shown, options: &ReadOptions) -> Result<Self, IoError> {
        let Shown { views, lights, pairs, files, mask, transfer } = shown;
        let first = files.first().ok_or_else(|| IoError::NoImages { path: archive.path().to_owned() })?;
        let header = raster::header(&archive.label(*first), &archive.read(*first)?)?;
        let encoding = options.encoding(Encoding::photograph(transfer.unwrap_or(header.transfer)));
        let btf = Btf::new(archive.stem(), header.size, views, lights, pairs, encoding)?;
        let mask = mask.map(|file| inside(&archive, file, header.size)).transpose()?;
        let transfer = if transfer.or(options.transfer).is_some() { None } else { Some(header.transfer) };
        Ok(Self { archive, btf, files, mask, transfer, linear: OnceLock::new() })
    }

    /// The radiance of the texels of `block`, `[channel][texel]`.
    fn radiance(&self, sample: usize, block: Block, radiance: &mut [f16]) -> Result<(), IoError> {
        let label = self.archive.label(self.files[sample]);
        let picture = raster::decode(&label, &self.archive.read(self.files[sample])?, self.btf.size())?;
        if let Some(expected) = self.transfer.filter(|expected| *expected != picture.transfer()) {
            return Err(IoError::OtherTransfer { file: label, found: picture.transfer(), expected });
        }
        let encoding = self.btf.encoding();
        let factor = encoding.factor(self.btf.directions(sample).1);
        let half = |linear: f64| radiance_half(factor * linear);
        match picture {
            Picture::Bytes(codes) => {
                let halves: Vec<f16> = (0..=255_u8).map(|code| half(encoding.linear(f64::from(code) / 255.0))).collect();
                self.cut(&codes, block, radiance, |code| halves[usize::from(code)]);
            }
            Picture::Words(codes) => {
                let curve = || (0..=u16::MAX).map(|code| encoding.linear(f64::from(code) / f64::from(u16::MAX))).collect();
                let linear = self.linear.get_or_init(curve);
                self.cut(&codes, block, radiance, |code| half(linear[usize::from(code)]));
            }
            Picture::Floats(values) => self.cut(&values, block, radiance, |value| half(encoding.linear(f64::from(value)))),
        }
        Ok(())
    }

    /// Writes the halves of `block`, `[channel][texel]`, of stored RGB.
    fn cut<T: Copy>(&self, stored: &[T], block: Block, radiance: &mut [f16], half: impl Fn(T) -> f16) {
        let ([width, height], texels) = (self.btf.size(), block.texels());
        for (index, row) in block.rows().enumerate() {
            let row = if self.btf.encoding().rows == RowOrder::TopDown { row } else { height - 1 - row };
            for (at, column) in block.columns().enumerate() {
                let texel = row * width + column;
                let is_inside = self.mask.as_ref().is_none_or(|mask| mask[texel]);
                for channel in 0..3 {
                    let value = if is_inside { half(stored[3 * texel + channel]) } else { f16::NAN };
                    radiance[channel * texels + index * block.width + at] = value;
                }
            }
        }
    }
}

/// Whether each texel of a mask is at least half as bright as can be.
fn inside(archive: &Archive, file: usize, size: [usize; 2]) -> Result<Vec<bool>, IoError> {
    Ok(match raster::decode(&archive.label(file), &archive.read(file)?, size)? {
        Picture::Bytes(codes) => codes.chunks_exact(3).map(|texel| texel.iter().any(|&code| code >= 128)).collect(),
        Picture::Words(codes) => codes.chunks_exact(3).map(|texel| texel.iter().any(|&code| code >= 32768)).collect(),
        Picture::Floats(values) => values.chunks_exact(3).map(|texel| texel.iter().any(|&value| value >= 0.5)).collect(),
    })
}

impl Source for Images {
    fn btf(&self) -> &Btf {
        &self.btf
    }

    fn read(&self, samples: &[usize], block: Block, radiance: &mut [f16], done: &(dyn Fn(usize) + Sync)) -> Result<(), IoError> {
        let texels = block.texels();
        assert!(block.is_within(self.btf.size()) && radiance.len() == 3 * samples.len() * texels, "the block and what it is read into");
        radiance.par_chunks_exact_mut(3 * texels).zip(samples).try_for_each(|(values, &sample)| {
            self.radiance(sample, block, values)?;
            done(1);
            Ok(())
        })
    }

    fn fingerprint(&self) -> String {
        let mask: Vec<u8> = self.mask.iter().flatten().map(|&inside| u8::from(inside)).collect();
        format!("{}, mask {:08x}", self.archive.fingerprint(&self.files), crc32fast::hash(&mask))
    }
}
