//! Measured sources: where a BTF's samples come from.

use std::{fmt::Debug, path::Path};

use super::{IoError, archive::Archive, tree::ImageTree};
use crate::data::Btf;

/// A measured BTF whose samples are decoded one by one, from any number of threads at once. Nothing is cached: each
/// call reads and decodes anew.
pub trait Source: Send + Sync + Debug {
    /// Name, size, directions and conventions.
    fn btf(&self) -> &Btf;

    /// The texels of sample `sample` of [`Btf::pairs`], `[row][column]`, row 0 at the top: 8-bit RGBA codes under
    /// [`Btf::transfer`], alpha 255.
    ///
    /// # Errors
    /// [`IoError`] if its file is missing, truncated, damaged, no image, or of another size than [`Btf::size`].
    ///
    /// # Panics
    /// If there is no such sample.
    fn decode(&self, sample: usize) -> Result<Vec<[u8; 4]>, IoError>;
}

/// Opens a folder, or a .zip archive without unpacking it, of images named by their directions. The name of the folder
/// or archive names the BTF.
///
/// # Errors
/// [`IoError`] if there is nothing, no image or no directions, if a pair is missing or there twice, or if the first
/// image cannot be read.
pub fn open(path: &Path) -> Result<Box<dyn Source>, IoError> {
    Ok(Box::new(ImageTree::open(Archive::open(path)?)?))
}

/// Opens a .zip archive that is in memory, as the sample embedded in the program is. `name` names the BTF.
///
/// # Errors
/// As [`open`].
pub fn open_zip_bytes(name: &str, bytes: &'static [u8]) -> Result<Box<dyn Source>, IoError> {
    Ok(Box::new(ImageTree::open(Archive::from_bytes(name, bytes)?)?))
}

/// Whether there is at least one image named by its directions.
pub(super) fn is_source(path: &Path) -> bool {
    Archive::open(path).is_ok_and(|archive| ImageTree::has_samples(&archive))
}
