//! Measured datasets as Zarr v3 groups: linear radiance as halves, chunked so that both an image tree can be imported in one pass that
//! holds one view, and a tile of texels can be read with all its samples.
//!
//! `radiance` is `[view][light][channel][row][column]`; a chunk is one view, all its lights, all channels and one tile of texels. Where
//! views have different lights the second axis counts each view's own, and `slot_light` says which they are. Chunks are compressed
//! by Blosc (LZ4 after a shuffle of bits) and end in a CRC-32C, which tells a damaged one. The values are those of the source, the
//! ones that are no radiance (NaN, infinite, negative) included.
//!
//! The group's own metadata are written when all chunks are there, and the folder is then renamed into place, so that nothing looks
//! complete that is not.

mod format;
mod reader;
mod writer;

use std::{fmt::Display, path::Path, sync::Arc};

use zarrs::{array::Array, filesystem::FilesystemStore};

pub use format::DATASET_FORMAT;
pub(super) use reader::open;
pub use writer::DatasetWriter;

use super::{ArrayFault, IoError, group};

type Store = Arc<FilesystemStore>;
type RadianceArray = Array<FilesystemStore>;

/// Whether `path` is a folder that says that it is a dataset, of whatever version.
pub(super) fn is_dataset(path: &Path) -> bool {
    group::attributes(path, DATASET_FORMAT).is_ok()
}

/// Checks that a dataset may be put at `path`: nothing is there, or a folder that holds a dataset and nothing else.
///
/// # Errors
/// [`IoError::Occupied`] if something else stands there, [`IoError::Read`] if it cannot be looked at.
pub fn check_target(path: &Path) -> Result<(), IoError> {
    group::check_target(path, DATASET_FORMAT, "dataset", &format::names())
}

fn fault(path: &Path, array: &'static str, fault: ArrayFault) -> IoError {
    IoError::Dataset { path: path.to_owned(), array, fault }
}

fn zarr_fault<'a>(path: &'a Path, array: &'static str) -> impl Fn(&dyn Display) -> IoError + 'a {
    move |error| fault(path, array, ArrayFault::Zarr(error.to_string()))
}
