//! The arrays of a material, each by its layout.

use std::{fmt::Display, path::Path, sync::Arc};

use half::f16;
use zarrs::{
    array::{Array, ArrayBuilder, CodecOptions, Element, ElementOwned, FillValue, codec::GzipCodec},
    filesystem::FilesystemStore,
    plugin::{ExtensionName, ZarrVersion},
};

use super::format::{Layout, Lengths};
use crate::{
    data::{Map, ShapeError},
    io::{ArrayFault, IoError},
};

/// A number that arrays hold.
pub(super) trait Number: Element + ElementOwned + Copy + Into<FillValue> {
    /// Its name in Zarr.
    const TYPE: &'static str;
    /// What a reader sees where a chunk is lost: a value that hardly any array has.
    const FILL: Self;
}

impl Number for f32 {
    const TYPE: &'static str = "float32";
    const FILL: Self = Self::NAN;
}

impl Number for f16 {
    const TYPE: &'static str = "float16";
    const FILL: Self = Self::NAN;
}

impl Number for u32 {
    const TYPE: &'static str = "uint32";
    const FILL: Self = Self::MAX;
}

impl Number for u8 {
    const TYPE: &'static str = "uint8";
    const FILL: Self = Self::MAX;
}

pub(super) struct Writer<'a> {
    pub(super) path: &'a Path,
    pub(super) store: Arc<FilesystemStore>,
    pub(super) lengths: Lengths,
}

impl Writer<'_> {
    /// Writes `values`, which are those of `map`.
    pub(super) fn map<T, N: Number>(&self, layout: &Layout, map: &Map<T>, values: &[N]) -> Result<(), IoError> {
        let [width, height] = self.lengths.plane;
        if [map.width(), map.height()] != [width, height] {
            return Err(ShapeError { width, height, expected: width * height, found: map.values().len() }.into());
        }
        self.values(layout, values)
    }

    /// Writes all values of an array.
    pub(super) fn values<N: Number>(&self, layout: &Layout, values: &[N]) -> Result<(), IoError> {
        let failed = |error: &dyn Display| fault(self.path, layout, ArrayFault::Zarr(error.to_string()));
        let gzip = GzipCodec::new(1).map_err(|error| failed(&error))?;
        let array = ArrayBuilder::new(layout.shape(&self.lengths), layout.chunk(&self.lengths), N::TYPE, N::FILL.into())
            .bytes_to_bytes_codecs(vec![Arc::new(gzip)])
            .dimension_names(Some(layout.dimensions()))
            .attributes(layout.attributes())
            .build(self.store.clone(), &format!("/{}", layout.name))
            .map_err(|error| failed(&error))?;
        array.store_metadata().map_err(|error| failed(&error))?;
        let every_chunk = CodecOptions::default().with_store_empty_chunks(true);
        array.store_array_subset_opt(&array.subset_all(), values, &every_chunk).map_err(|error| failed(&error))
    }
}

pub(super) struct Reader<'a> {
    pub(super) path: &'a Path,
    pub(super) store: Arc<FilesystemStore>,
    pub(super) lengths: Lengths,
}

impl Reader<'_> {
    pub(super) fn scalars<N: Number>(&self, layout: &Layout) -> Result<Map<N>, IoError> {
        let [width, height] = self.lengths.plane;
        Ok(Map::new(width, height, self.values(layout)?)?)
    }

    pub(super) fn vectors<const COMPONENTS: usize>(&self, layout: &Layout) -> Result<Map<[f32; COMPONENTS]>, IoError> {
        let [width, height] = self.lengths.plane;
        Ok(Map::new(width, height, self.values(layout)?.as_chunks().0.to_vec())?)
    }

    /// All values of an array. They are allocated once type, shape and the presence of every chunk are known.
    pub(super) fn values<N: Number>(&self, layout: &Layout) -> Result<Vec<N>, IoError> {
        let failed = |error: &dyn Display| fault(self.path, layout, ArrayFault::Zarr(error.to_string()));
        let expect = |what, expected: String, found: String| {
            if expected == found { Ok(()) } else { Err(fault(self.path, layout, ArrayFault::Unexpected { what, expected, found })) }
        };
        let array = Array::open(self.store.clone(), &format!("/{}", layout.name)).map_err(|error| failed(&error))?;
        let (shape, chunk) = (layout.shape(&self.lengths), layout.chunk(&self.lengths));
        expect("data type", N::TYPE.to_owned(), array.data_type().name(ZarrVersion::V3).unwrap_or_default().into_owned())?;
        expect("shape", format!("{shape:?}"), format!("{:?}", array.shape()))?;
        let origin = vec![0; shape.len()];
        let found: Vec<u64> = array.chunk_shape(&origin).map_err(|error| failed(&error))?.iter().map(|side| side.get()).collect();
        expect("chunks of shape", format!("{chunk:?}"), format!("{found:?}"))?;

        let chunks: Vec<u64> = shape.iter().zip(&chunk).map(|(length, side)| length.div_ceil(*side)).collect();
        for place in std::iter::successors(Some(origin), |place| following(place, &chunks)) {
            let key = array.chunk_key(&place);
            if !self.path.join(key.as_str()).is_file() {
                return Err(fault(self.path, layout, ArrayFault::MissingChunk { chunk: key.to_string() }));
            }
        }
        array.retrieve_array_subset(&array.subset_all()).map_err(|error| failed(&error))
    }
}

/// The place after `place` in a grid of `lengths`, the last index first.
fn following(place: &[u64], lengths: &[u64]) -> Option<Vec<u64>> {
    let depth = place.iter().zip(lengths).rposition(|(index, length)| index + 1 < *length)?;
    let index = |(at, &index): (usize, &u64)| match at.cmp(&depth) {
        std::cmp::Ordering::Less => index,
        std::cmp::Ordering::Equal => index + 1,
        std::cmp::Ordering::Greater => 0,
    };
    Some(place.iter().enumerate().map(index).collect())
}

pub(super) fn fault(path: &Path, layout: &Layout, fault: ArrayFault) -> IoError {
    IoError::Array { path: path.to_owned(), array: layout.name, fault }
}
