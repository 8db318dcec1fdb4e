//! Measured sources: where a BTF's samples come from.

use std::{fmt::Debug, path::Path};

use half::f16;

use super::{IoError, archive::Archive, dataset, tree::ImageTree};
use crate::data::{Block, Btf, Encoding, Map, RowOrder, Transfer};

/// A measured BTF whose samples are read from where they lie, from any number of threads at once. Nothing is cached: each call
/// reads and decodes anew.
pub trait Source: Send + Sync + Debug {
    /// Name, size, directions and encoding.
    fn btf(&self) -> &Btf;

    /// Columns and rows of the blocks that are stored together with all their samples; `None` if each sample is stored as a picture of the
    /// whole plane, so that a part of it costs as much as all of it.
    fn chunk(&self) -> Option<[usize; 2]> {
        None
    }

    /// Reads the radiance of `block` in each of `samples` (indices into [`Btf::pairs`], ascending) into `radiance`,
    /// `[sample][channel][texel of the block]`: linear RGB in reflectance units, the top row first. What is no radiance, because it is
    /// negative, infinite or not a number, comes as it is stored. Works on all cores; `done(n)` is told whenever n more samples are read.
    ///
    /// # Errors
    /// [`IoError`] if something is missing, truncated, damaged, or other than the source's description has it.
    ///
    /// # Panics
    /// If there is no such sample, `block` is not within the plane, or `radiance` has another length.
    fn read(&self, samples: &[usize], block: Block, radiance: &mut [f16], done: &(dyn Fn(usize) + Sync)) -> Result<(), IoError>;

    /// A text that is another as soon as a file of the source is another, as far as names, sizes and times of modification tell.
    fn fingerprint(&self) -> String;

    /// The radiance of sample `sample` as a picture.
    ///
    /// # Errors
    /// As [`Self::read`].
    ///
    /// # Panics
    /// If there is no such sample.
    fn picture(&self, sample: usize) -> Result<Map<[f32; 3]>, IoError> {
        let [width, height] = self.btf().size();
        let mut radiance = vec![f16::ZERO; 3 * width * height];
        self.read(&[sample], Block::whole([width, height]), &mut radiance, &|_| {})?;
        let channel = |channel: usize, texel: usize| radiance[channel * width * height + texel].to_f32();
        Ok(Map::from_fn(width, height, |column, row| [0, 1, 2].map(|c| channel(c, row * width + column))))
    }
}

/// What a user knows better than a reader.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ReadOptions {
    /// From stored values to linear ones, for every image whatever its format.
    pub transfer: Option<Transfer>,
    /// Whether the stored values have the light's cosine in them.
    pub includes_cosine: Option<bool>,
    /// Which row is stored first.
    pub rows: Option<RowOrder>,
    /// Factor from linear values to reflectance units.
    pub scale: Option<f64>,
}

impl ReadOptions {
    /// The encoding that a reader found, as far as the user does not know better.
    #[must_use]
    pub fn encoding(&self, found: Encoding) -> Encoding {
        Encoding {
            transfer: self.transfer.unwrap_or(found.transfer),
            includes_cosine: self.includes_cosine.unwrap_or(found.includes_cosine),
            rows: self.rows.unwrap_or(found.rows),
            scale: self.scale.unwrap_or(found.scale),
            texels_per_mm: found.texels_per_mm,
        }
    }
}

/// Opens a dataset, or a folder or a .zip archive (without unpacking it) of images named by their directions. The name of the folder
/// or archive names the BTF.
///
/// # Errors
/// [`IoError`] if there is nothing, no image or no directions, if a pair is missing or there twice, or if the first
/// image cannot be read.
pub fn open(path: &Path) -> Result<Box<dyn Source>, IoError> {
    open_with(path, &ReadOptions::default())
}

/// As [`open`], where the user knows better than the reader.
///
/// # Errors
/// As [`open`].
pub fn open_with(path: &Path, options: &ReadOptions) -> Result<Box<dyn Source>, IoError> {
    if dataset::is_dataset(path) {
        if *options != ReadOptions::default() {
            return Err(IoError::AlreadyRadiance { path: path.to_owned() });
        }
        return dataset::open(path);
    }
    Ok(Box::new(ImageTree::open(Archive::open(path)?, options)?))
}

/// Opens a .zip archive that is in memory, as the sample embedded in the program is. `name` names the BTF.
///
/// # Errors
/// As [`open`].
pub fn open_zip_bytes(name: &str, bytes: &'static [u8]) -> Result<Box<dyn Source>, IoError> {
    Ok(Box::new(ImageTree::open(Archive::from_bytes(name, bytes)?, &ReadOptions::default())?))
}

/// Whether it is a dataset or there is at least one image named by its directions.
pub(super) fn is_source(path: &Path) -> bool {
    dataset::is_dataset(path) || Archive::open(path).is_ok_and(|archive| ImageTree::has_samples(&archive))
}
