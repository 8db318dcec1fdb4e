//! Readers and writers: measured sources, recovered materials, pictures.
//!
//! A reader checks what a file declares before it allocates for it. What is written appears under its name whole or
//! not at all: it is made in a hidden folder beside its target and renamed into place.

mod archive;
mod btf_file;
pub mod conventions;
pub mod dataset;
pub mod environment;
mod error;
pub mod export;
mod group;
mod images;
pub mod job;
pub mod lights;
pub mod material;
pub mod mesh;
mod names;
pub mod paints;
pub mod picture;
mod raster;
pub mod recipe;
mod selection;
mod source;
mod staging;
mod tree;
mod tree_writer;
mod unfinished;

use std::path::Path;

pub use btf_file::BtfFileError;
pub use error::{ArrayFault, IoError};
pub use mesh::{MeshFault, MeshFileError};
pub use names::directions_in_name;
pub use recipe::{RecipeError, RecipeFault};
pub use selection::SelectionFault;
pub use source::{ReadOptions, Source, open, open_btf_bytes, open_with, open_zip_bytes};
pub use staging::write;
pub use tree_writer::{Lost, TreeFormat, TreeWriter};
pub use unfinished::Unfinished;

/// What a path holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A recovered material, which [`material::load`] reads.
    Material,
    /// Images with directions in their names or in a light file, or a dataset, which [`open`] reads.
    Source,
    /// Neither; the error of [`open`] says why.
    Neither,
}

/// What `path` holds, judged by a material's attributes and by the names of files. No image is read.
#[must_use]
pub fn kind(path: &Path) -> Kind {
    if material::is_material(path) {
        Kind::Material
    } else if source::is_source(path) {
        Kind::Source
    } else {
        Kind::Neither
    }
}
