//! A dataset as a source.

use std::path::{Path, PathBuf};

use half::f16;
use rayon::prelude::*;
use zarrs::{
    array::{Array, ElementOwned},
    filesystem::FilesystemStore,
    plugin::{ExtensionName, ZarrVersion},
};

use super::{DATASET_FORMAT, RadianceArray, Store, fault, format, zarr_fault};
use crate::{
    data::{Block, Btf, Direction, Encoding, Pair},
    io::{ArrayFault, IoError, Source, group},
};

/// A dataset. Opening it reads its description and no chunk of radiance.
#[derive(Debug)]
struct Dataset {
    path: PathBuf,
    btf: Btf,
    radiance: RadianceArray,
    side: usize,
    /// (view, slot) of each sample.
    places: Vec<(usize, usize)>,
    slots: usize,
}

/// Opens the dataset in folder `path`.
pub(in crate::io) fn open(path: &Path) -> Result<Box<dyn Source>, IoError> {
    let not_a_dataset = |found: String| IoError::NotADataset { path: path.to_owned(), found };
    let attributes = group::attributes(path, DATASET_FORMAT).map_err(not_a_dataset)?;
    let version = &attributes["format_version"];
    if version.as_u64() != Some(format::VERSION) {
        let (what, expected) = ("dataset", format::VERSION);
        return Err(IoError::Version { path: path.to_owned(), what, found: version.to_string(), expected });
    }
    let attribute = |name: &str| &attributes[name];
    let wrong = |name: &str| not_a_dataset(format!("its attribute \"{name}\" is {}", attribute(name)));
    let side = |name| attribute(name).as_u64().and_then(|side| usize::try_from(side).ok()).ok_or_else(|| wrong(name));
    let size = [side("width")?, side("height")?];
    let name = attribute("name").as_str().ok_or_else(|| wrong("name"))?.to_owned();
    let encoding: Encoding = serde_json::from_value(attribute("encoding").clone()).map_err(|_| wrong("encoding"))?;

    let store = Store::new(FilesystemStore::new(path).map_err(|error| not_a_dataset(error.to_string()))?);
    let reader = Reader { path, store };
    let radiance = reader.open(format::RADIANCE, "float16", 5)?;
    let shape: Vec<usize> = radiance.shape().iter().map(|&side| usize::try_from(side).unwrap_or(usize::MAX)).collect();
    let directions = |theta, phi| -> Result<Vec<Direction>, IoError> {
        let angles = reader.values::<f64>(theta, "float64", 1)?.0.into_iter().zip(reader.values::<f64>(phi, "float64", 1)?.0);
        Ok(angles.map(|(theta, phi)| Direction::from_degrees(theta, phi)).collect())
    };
    let (views, lights) = (directions("view_theta", "view_phi")?, directions("light_theta", "light_phi")?);
    let pairs: Vec<Pair> = if path.join(format::SLOT_LIGHT).exists() {
        let (slot_lights, shape) = reader.values::<i32>(format::SLOT_LIGHT, "int32", 2)?;
        let slots = usize::try_from(shape[1]).unwrap_or(usize::MAX).max(1);
        let light = |(index, &light): (usize, &i32)| Some(Pair { view: index / slots, light: usize::try_from(light).ok()? });
        slot_lights.iter().enumerate().filter_map(light).collect()
    } else {
        (0..views.len()).flat_map(|view| (0..lights.len()).map(move |light| Pair { view, light })).collect()
    };
    let btf = Btf::new(name, size, views, lights, pairs, encoding)?;
    let slots = format::slots(&btf);
    reader.expect(format::RADIANCE, "shape", &[btf.views().len(), slots, 3, size[1], size[0]][..], &shape[..])?;
    let chunk = radiance.chunk_shape(&[0; 5]).map_err(|error| zarr_fault(path, format::RADIANCE)(&error))?;
    let chunk: Vec<usize> = chunk.iter().map(|side| usize::try_from(side.get()).unwrap_or(usize::MAX)).collect();
    let side = format::side(btf.pairs().len());
    reader.expect(format::RADIANCE, "chunks of shape", &[1, slots, 3, side, side][..], &chunk[..])?;
    let places = format::places(&btf);
    Ok(Box::new(Dataset { path: path.to_owned(), btf, radiance, side, places, slots }))
}

struct Reader<'a> {
    path: &'a Path,
    store: Store,
}

impl Reader<'_> {
    fn open(&self, name: &'static str, data_type: &'static str, dimensions: usize) -> Result<RadianceArray, IoError> {
        let failed = zarr_fault(self.path, name);
        let array = Array::open(self.store.clone(), &format!("/{name}")).map_err(|error| failed(&error))?;
        self.expect(name, "data type", data_type, array.data_type().name(ZarrVersion::V3).unwrap_or_default().as_ref())?;
        self.expect(name, "dimensions", &dimensions, &array.shape().len())?;
        Ok(array)
    }

    /// All values of a small array and its shape.
    fn values<T: ElementOwned>(
        &self, name: &'static str, data_type: &'static str, dimensions: usize,
    ) -> Result<(Vec<T>, Vec<u64>), IoError> {
        let array = self.open(name, data_type, dimensions)?;
        let shape = array.shape().to_vec();
        // More directions than anyone has photographed.
        if shape.iter().try_fold(1_u64, |product, &side| product.checked_mul(side)).is_none_or(|count| count > 1 << 24) {
            return Err(fault(self.path, name, ArrayFault::Zarr(format!("its shape is {shape:?}"))));
        }
        let values = array.retrieve_array_subset(&array.subset_all()).map_err(|error| zarr_fault(self.path, name)(&error))?;
        Ok((values, shape))
    }

    fn expect<T: PartialEq + std::fmt::Debug + ?Sized>(
        &self, name: &'static str, what: &'static str, expected: &T, found: &T,
    ) -> Result<(), IoError> {
        if expected == found {
            return Ok(());
        }
        Err(fault(self.path, name, ArrayFault::Unexpected { what, expected: format!("{expected:?}"), found: format!("{found:?}") }))
    }
}

impl Source for Dataset {
    fn btf(&self) -> &Btf {
        &self.btf
    }

    fn chunk(&self) -> Option<[usize; 2]> {
        Some([self.side; 2])
    }

    fn read(&self, samples: &[usize], block: Block, radiance: &mut [f16], done: &(dyn Fn(usize) + Sync)) -> Result<(), IoError> {
        let texels = block.texels();
        assert!(block.is_within(self.btf.size()) && radiance.len() == 3 * samples.len() * texels, "the block and what it is read into");
        // Samples are in the order of views: one task a view, which reads each of its chunks once.
        let mut tasks = Vec::new();
        let mut rest = radiance;
        for of_view in samples.chunk_by(|&a, &b| self.places[a].0 == self.places[b].0) {
            let (values, after) = rest.split_at_mut(3 * of_view.len() * texels);
            tasks.push((of_view, values));
            rest = after;
        }
        tasks.into_par_iter().try_for_each(|(samples, values)| {
            let tiles = Block::tiles(self.btf.size(), [self.side; 2]);
            for (tile, common) in tiles.filter_map(|tile| Some((tile, tile.intersection(&block)?))) {
                let stored = self.chunk_of(self.places[samples[0]].0, tile)?;
                for (values, &sample) in values.chunks_exact_mut(3 * texels).zip(samples) {
                    for (channel, values) in values.chunks_exact_mut(texels).enumerate() {
                        let plane = (self.places[sample].1 * 3 + channel) * self.side * self.side;
                        for row in common.rows() {
                            let from = plane + (row - tile.row) * self.side + common.column - tile.column;
                            let to = (row - block.row) * block.width + common.column - block.column;
                            values[to..to + common.width].copy_from_slice(&stored[from..from + common.width]);
                        }
                    }
                }
            }
            done(samples.len());
            Ok(())
        })
    }

    fn fingerprint(&self) -> String {
        let metadata = std::fs::metadata(self.path.join("zarr.json"));
        let modified =
            metadata.and_then(|metadata| metadata.modified()).ok().and_then(|time| time.duration_since(std::time::UNIX_EPOCH).ok());
        format!("dataset of {} ns", modified.unwrap_or_default().as_nanos())
    }
}

impl Dataset {
    /// The values of one chunk, `[slot][channel][row][column]`.
    fn chunk_of(&self, view: usize, tile: Block) -> Result<Vec<f16>, IoError> {
        let chunk = [view, 0, 0, tile.row / self.side, tile.column / self.side].map(|index| index as u64);
        let key = self.radiance.chunk_key(&chunk).to_string();
        match self.radiance.retrieve_chunk_if_exists::<Vec<f16>>(&chunk) {
            Ok(Some(values)) if values.len() == self.slots * 3 * self.side * self.side => Ok(values),
            Ok(Some(values)) => Err(self.fault(ArrayFault::Zarr(format!("chunk {key} holds {} values", values.len())))),
            Ok(None) => Err(self.fault(ArrayFault::MissingChunk { chunk: key })),
            Err(error) => Err(self.fault(ArrayFault::Zarr(format!("chunk {key}: {error}")))),
        }
    }

    fn fault(&self, fault: ArrayFault) -> IoError {
        super::fault(&self.path, format::RADIANCE, fault)
    }
}
