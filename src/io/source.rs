//! Measured sources: where a BTF's samples come from.

use std::{fmt::Debug, path::Path, sync::Arc};

use half::f16;

use super::{IoError, archive::Archive, btf_file::BtfFile, dataset, lights, selection, tree};
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
    /// The only texels to be read.
    pub region: Option<Block>,
    /// Every how many directions one is read, of views and of lights; the view nearest to the zenith always is.
    pub every: Option<usize>,
    /// The largest θ of a view or light that is read, in degrees.
    pub max_theta: Option<f64>,
}

impl ReadOptions {
    /// Whether anything is said of how stored values become radiance.
    fn states_encoding(&self) -> bool {
        let &Self { transfer, includes_cosine, rows, scale, region: _, every: _, max_theta: _ } = self;
        transfer.is_some() || includes_cosine.is_some() || rows.is_some() || scale.is_some()
    }

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

/// Opens a dataset; a `.btf` container, which is known by its first bytes; or a folder or a .zip archive (without unpacking it) of images:
/// named by their directions, else those of a light file (see [`lights`]). An `.lp` light file may be named itself. The name of the folder,
/// archive or container names the BTF.
///
/// # Errors
/// [`IoError`] if there is nothing, no image or no directions, if a pair is there twice, if the first image cannot be read, or if a container's
/// header is damaged or of an unknown kind.
pub fn open(path: &Path) -> Result<Box<dyn Source>, IoError> {
    open_with(path, &ReadOptions::default())
}

/// As [`open`], where the user knows better than the reader, or wants a part of it.
///
/// # Errors
/// As [`open`], or if nothing is left of it.
pub fn open_with(path: &Path, options: &ReadOptions) -> Result<Box<dyn Source>, IoError> {
    selection::select(open_whole(path, options)?, options)
}

fn open_whole(path: &Path, options: &ReadOptions) -> Result<Box<dyn Source>, IoError> {
    if dataset::is_dataset(path) {
        if options.states_encoding() {
            return Err(IoError::AlreadyRadiance { path: path.to_owned() });
        }
        return dataset::open(path);
    }
    if BtfFile::is_one(path) {
        return Ok(Box::new(BtfFile::open(path, options)?));
    }
    if let Some((folder, name)) = light_file(path) {
        return Ok(Box::new(lights::open(Archive::open(folder)?, Some(name), options)?));
    }
    open_images(Archive::open(path)?, options)
}

/// Opens a `.btf` container that is in memory. `name` names the BTF, and the file in errors.
///
/// # Errors
/// As [`open`].
pub fn open_btf_bytes(name: &str, bytes: impl Into<Arc<[u8]>>, options: &ReadOptions) -> Result<Box<dyn Source>, IoError> {
    selection::select(Box::new(BtfFile::from_bytes(name, bytes.into(), options)?), options)
}

/// Opens a .zip archive that is in memory, as the sample embedded in the program is. `name` names the BTF.
///
/// # Errors
/// As [`open`].
pub fn open_zip_bytes(name: &str, bytes: &'static [u8]) -> Result<Box<dyn Source>, IoError> {
    open_images(Archive::from_bytes(name, bytes)?, &ReadOptions::default())
}

fn open_images(archive: Archive, options: &ReadOptions) -> Result<Box<dyn Source>, IoError> {
    let by_light_file = !tree::has_samples(&archive) && lights::has_lights(&archive);
    Ok(Box::new(if by_light_file { lights::open(archive, None, options)? } else { tree::open(archive, options)? }))
}

/// Folder and name of a light file that may be named itself.
fn light_file(path: &Path) -> Option<(&Path, &str)> {
    let is_lp = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("lp")) && path.is_file();
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    Some((folder, path.file_name()?.to_str()?)).filter(|_| is_lp)
}

/// Whether it is a dataset or a `.btf` container, or there are images and directions for them, judged by names.
pub(super) fn is_source(path: &Path) -> bool {
    let has_images = |archive| tree::has_samples(&archive) || lights::has_lights(&archive);
    dataset::is_dataset(path) || BtfFile::has_signature(path) || light_file(path).is_some() || Archive::open(path).is_ok_and(has_images)
}
