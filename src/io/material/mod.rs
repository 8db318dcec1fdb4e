//! Recovered materials as Zarr v3 groups: one array a map, open, chunked, readable from Python.
//!
//! The group's own metadata are written last and the folder is renamed into place, so that a killed [`save`] leaves
//! nothing that [`load`] takes. Every chunk is stored, and gzip's checksum tells a damaged one; an absent chunk, which
//! Zarr reads as fill values, is an error here. [`load`] looks at nothing but the arrays that it knows; [`save`] does not
//! replace a group that holds anything else.

mod format;

use std::{fmt::Display, path::Path, sync::Arc};

use serde_json::json;
use zarrs::{
    array::{Array, ArrayBuilder, CodecOptions, Element, ElementOwned, FillValue, codec::GzipCodec},
    filesystem::FilesystemStore,
    group::GroupBuilder,
    plugin::{ExtensionName, ZarrVersion},
};

use format::Layout;
pub use format::MATERIAL_FORMAT;

use super::{ArrayFault, IoError, conventions, group, staging::Staging};
use crate::{
    data::{Choice, Fit, FitStatus, Lobe, MAX_LOBES, Map, Material, Provenance, ShapeError, Svbrdf},
    model::Frame,
};

/// Writes `material` as the folder `path`. Another material there is replaced; anything else is left as it is.
///
/// # Errors
/// [`IoError`] if something else stands there, the maps do not cover one plane, or the system refuses to write.
pub fn save(path: &Path, material: &Material) -> Result<(), IoError> {
    check_target(path)?;
    let staging = Staging::beside(path)?;
    let new = staging.path();
    let store = Arc::new(FilesystemStore::new(&new).map_err(|error| not_written(path, &error))?);
    let writer = Writer { path, store: store.clone(), size: material.size() };

    writer.store(&format::HEIGHT, &material.height, material.height.values())?;
    writer.store(&format::NORMAL, &material.normal, material.normal.values().as_flattened())?;
    writer.store(&format::NORMAL_MEASURED, &material.normal_measured, material.normal_measured.values().as_flattened())?;
    writer.store(&format::ALBEDO, &material.albedo, material.albedo.values())?;
    let Svbrdf { frame, ambient, diffuse, lobes } = &material.svbrdf;
    writer.store(&format::DIFFUSE, diffuse, diffuse.values().as_flattened())?;
    for (index, Lobe { specular, parameters }) in lobes.iter().enumerate().take(MAX_LOBES) {
        writer.store(&format::SPECULAR[index], specular, specular.values().as_flattened())?;
        writer.store(&format::LOBE[index], parameters, parameters.values().as_flattened())?;
    }
    let Fit { objective_without_lobe, objective, iterations, status, masked } = &material.fit;
    writer.store(&format::OBJECTIVE_WITHOUT_LOBE, objective_without_lobe, objective_without_lobe.values())?;
    writer.store(&format::OBJECTIVE, objective, objective.values())?;
    writer.store(&format::ITERATIONS, iterations, iterations.values())?;
    let codes: Vec<u8> = status.values().iter().map(|&code| status_code(path, code)).collect::<Result<_, _>>()?;
    writer.store(&format::STATUS, status, &codes)?;
    writer.store(&format::MASKED, masked, masked.values())?;

    let [width, height] = material.size();
    let provenance = serde_json::to_value(&material.provenance).map_err(|error| not_written(path, &error))?;
    let attributes = [
        ("format", json!(MATERIAL_FORMAT)),
        ("format_version", json!(format::VERSION)),
        ("width", json!(width)),
        ("height", json!(height)),
        ("frame", json!(frame)),
        ("ambient", json!(ambient)),
        ("choice", json!(material.choice)),
        ("lobes", json!(lobes.len())),
        ("conventions", conventions::MATERIAL.iter().copied().collect()),
        ("provenance", provenance),
    ];
    let mut group = GroupBuilder::new();
    group.attributes(attributes.into_iter().map(|(name, value)| (name.to_owned(), value)).collect());
    let group = group.build(store, "/").map_err(|error| not_written(path, &error))?;
    group.store_metadata().map_err(|error| not_written(path, &error))?;
    staging.commit()
}

/// Reads the material in folder `path`.
///
/// # Errors
/// [`IoError`] if there is no material, its version is another, or an array is missing, damaged, or of another type or
/// shape than the format has it.
pub fn load(path: &Path) -> Result<Material, IoError> {
    if !path.exists() {
        return Err(IoError::NotFound { path: path.to_owned() });
    }
    let not_a_material = |found: String| IoError::NotAMaterial { path: path.to_owned(), found };
    let attributes = group::attributes(path, MATERIAL_FORMAT).map_err(not_a_material)?;
    let version = &attributes["format_version"];
    if version.as_u64() != Some(format::VERSION) {
        return Err(IoError::Version { path: path.to_owned(), what: "material", found: version.to_string(), expected: format::VERSION });
    }
    let side = |name: &str| {
        let side = attributes[name].as_u64().and_then(|side| usize::try_from(side).ok()).filter(|&side| side > 0);
        side.ok_or_else(|| not_a_material(format!("its attribute \"{name}\" is {}", attributes[name])))
    };
    let size @ [width, height] = [side("width")?, side("height")?];
    let frame: Frame = serde_json::from_value(attributes["frame"].clone())
        .map_err(|error| not_a_material(format!("its attribute \"frame\" cannot be read: {error}")))?;
    let choice: Choice = serde_json::from_value(attributes["choice"].clone())
        .map_err(|error| not_a_material(format!("its attribute \"choice\" cannot be read: {error}")))?;
    let ambient = attributes["ambient"].as_f64().filter(|ambient| (0.0..=1.0).contains(ambient));
    let ambient = ambient.ok_or_else(|| not_a_material(format!("its attribute \"ambient\" is {}", attributes["ambient"])))?;
    let lobes = attributes["lobes"].as_u64().and_then(|lobes| usize::try_from(lobes).ok()).filter(|lobes| (1..=MAX_LOBES).contains(lobes));
    let lobes = lobes.ok_or_else(|| not_a_material(format!("its attribute \"lobes\" is {}", attributes["lobes"])))?;
    let provenance: Provenance = serde_json::from_value(attributes["provenance"].clone())
        .map_err(|error| not_a_material(format!("its attribute \"provenance\" cannot be read: {error}")))?;

    let store = Arc::new(FilesystemStore::new(path).map_err(|error| not_a_material(error.to_string()))?);
    let reader = Reader { path, store, size };
    let lobe =
        |index: usize| Ok(Lobe { specular: reader.vectors(&format::SPECULAR[index])?, parameters: reader.vectors(&format::LOBE[index])? });
    let lobes = (0..lobes).map(lobe).collect::<Result<_, IoError>>()?;
    let status: Vec<u8> = reader.retrieve(&format::STATUS)?;
    let status: Vec<u32> = status.into_iter().map(u32::from).collect();
    for &code in &status {
        status_code(path, code)?;
    }
    Ok(Material {
        height: reader.scalars(&format::HEIGHT)?,
        normal: reader.vectors(&format::NORMAL)?,
        normal_measured: reader.vectors(&format::NORMAL_MEASURED)?,
        albedo: reader.scalars(&format::ALBEDO)?,
        svbrdf: Svbrdf { frame, ambient, diffuse: reader.vectors(&format::DIFFUSE)?, lobes },
        lpca: None,
        fit: Fit {
            objective_without_lobe: reader.scalars(&format::OBJECTIVE_WITHOUT_LOBE)?,
            objective: reader.scalars(&format::OBJECTIVE)?,
            iterations: reader.scalars(&format::ITERATIONS)?,
            status: Map::new(width, height, status)?,
            masked: reader.scalars(&format::MASKED)?,
        },
        choice,
        provenance,
    })
}

/// Whether `path` is a folder that says that it is a material, of whatever version.
pub(super) fn is_material(path: &Path) -> bool {
    group::attributes(path, MATERIAL_FORMAT).is_ok()
}

/// Checks that [`save`] may put a material at `path`: nothing is there, or a folder that holds a material and nothing else. [`save`]
/// asks the same; whoever computes for long before it can ask first.
///
/// # Errors
/// [`IoError::Occupied`] if something else stands there, [`IoError::Read`] if it cannot be looked at.
pub fn check_target(path: &Path) -> Result<(), IoError> {
    group::check_target(path, MATERIAL_FORMAT, "material", &format::NAMES)
}

/// A number that arrays hold.
trait Number: Element + ElementOwned + Copy + Into<FillValue> {
    /// Its name in Zarr.
    const TYPE: &'static str;
    /// What a reader sees where a chunk is lost: a value that no map has.
    const FILL: Self;
}

impl Number for f32 {
    const TYPE: &'static str = "float32";
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

struct Writer<'a> {
    path: &'a Path,
    store: Arc<FilesystemStore>,
    size: [usize; 2],
}

impl Writer<'_> {
    /// Writes `values`, which are those of `map`.
    fn store<T, N: Number>(&self, layout: &Layout, map: &Map<T>, values: &[N]) -> Result<(), IoError> {
        let [width, height] = self.size;
        if [map.width(), map.height()] != self.size {
            return Err(ShapeError { width, height, expected: width * height, found: map.values().len() }.into());
        }
        let failed = |error: &dyn Display| fault(self.path, layout, ArrayFault::Zarr(error.to_string()));
        let gzip = GzipCodec::new(1).map_err(|error| failed(&error))?;
        let array = ArrayBuilder::new(layout.shape(self.size), layout.chunk(self.size), N::TYPE, N::FILL.into())
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

struct Reader<'a> {
    path: &'a Path,
    store: Arc<FilesystemStore>,
    size: [usize; 2],
}

impl Reader<'_> {
    fn scalars<N: Number>(&self, layout: &Layout) -> Result<Map<N>, IoError> {
        let [width, height] = self.size;
        Ok(Map::new(width, height, self.retrieve(layout)?)?)
    }

    fn vectors<const COMPONENTS: usize>(&self, layout: &Layout) -> Result<Map<[f32; COMPONENTS]>, IoError> {
        let [width, height] = self.size;
        Ok(Map::new(width, height, self.retrieve(layout)?.as_chunks().0.to_vec())?)
    }

    /// All values of an array. They are allocated once type, shape and the presence of every chunk are known.
    fn retrieve<N: Number>(&self, layout: &Layout) -> Result<Vec<N>, IoError> {
        let failed = |error: &dyn Display| fault(self.path, layout, ArrayFault::Zarr(error.to_string()));
        let expect = |what, expected: String, found: String| {
            if expected == found { Ok(()) } else { Err(fault(self.path, layout, ArrayFault::Unexpected { what, expected, found })) }
        };
        let array = Array::open(self.store.clone(), &format!("/{}", layout.name)).map_err(|error| failed(&error))?;
        let (shape, chunk) = (layout.shape(self.size), layout.chunk(self.size));
        expect("data type", N::TYPE.to_owned(), array.data_type().name(ZarrVersion::V3).unwrap_or_default().into_owned())?;
        expect("shape", format!("{shape:?}"), format!("{:?}", array.shape()))?;
        let origin = vec![0; shape.len()];
        let found: Vec<u64> = array.chunk_shape(&origin).map_err(|error| failed(&error))?.iter().map(|side| side.get()).collect();
        expect("chunks of shape", format!("{chunk:?}"), format!("{found:?}"))?;

        let [width, height] = self.size;
        let places = || (0..height).step_by(format::CHUNK).flat_map(|top| (0..width).step_by(format::CHUNK).map(move |left| [top, left]));
        let indices = |place: [usize; 2]| [&place.map(|texel| (texel / format::CHUNK) as u64)[..], &origin[2..]].concat();
        for place in places() {
            let key = array.chunk_key(&indices(place));
            if !self.path.join(key.as_str()).is_file() {
                return Err(fault(self.path, layout, ArrayFault::MissingChunk { chunk: key.to_string() }));
            }
        }
        array.retrieve_array_subset(&array.subset_all()).map_err(|error| failed(&error))
    }
}

fn status_code(path: &Path, code: u32) -> Result<u8, IoError> {
    let known = FitStatus::from_code(code).map(|status| status as u8);
    let codes = 0..FitStatus::ALL.len();
    let unknown = || ArrayFault::Unexpected { what: "codes", expected: format!("{codes:?}"), found: code.to_string() };
    known.ok_or_else(|| fault(path, &format::STATUS, unknown()))
}

fn fault(path: &Path, layout: &Layout, fault: ArrayFault) -> IoError {
    IoError::Array { path: path.to_owned(), array: layout.name, fault }
}

fn not_written(path: &Path, error: &dyn Display) -> IoError {
    IoError::Write { path: path.to_owned(), source: std::io::Error::other(error.to_string()) }
}
