//! Trees of images named by their directions, as Bonn publishes them: `tv030_pv090/00123 tl015 pl060 tv030 pv090.jpg`.

use std::{
    collections::BTreeSet,
    io::Cursor,
    path::{Path, PathBuf},
};

use exr::prelude::{Image, SpecificChannels, Vec2, WritableImage};
use half::f16;
use image::{ExtendedColorType, ImageEncoder, ImageError, codecs::jpeg::JpegEncoder, codecs::png::PngEncoder};
use rayon::prelude::*;

use super::IoError;
use crate::{
    data::{Btf, Direction},
    model::color::srgb_from_linear,
};

/// How images of a tree are stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TreeFormat {
    /// 8-bit sRGB, lossy, of a quality from 1 to 100.
    Jpeg(u8),
    /// 8-bit sRGB.
    Png,
    /// Linear halves, nothing lost.
    Exr,
}

impl TreeFormat {
    fn extension(self) -> &'static str {
        match self {
            Self::Jpeg(_) => "jpg",
            Self::Png => "png",
            Self::Exr => "exr",
        }
    }
}

/// What a tree's form could not hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Lost {
    /// Values above 1, which 8 bits hold as 1.
    pub clipped: usize,
    /// Values that are no radiance (NaN, infinite or negative), which 8 bits hold as 0.
    pub invalid: usize,
}

impl std::ops::Add for Lost {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { clipped: self.clipped + other.clipped, invalid: self.invalid + other.invalid }
    }
}

/// Writes the images of one BTF. Each appears under its name whole or not at all; images of an earlier run are replaced.
#[derive(Debug)]
pub struct TreeWriter {
    folder: PathBuf,
    format: TreeFormat,
    size: [usize; 2],
    /// Folder and file of each sample.
    names: Vec<(String, String)>,
}

impl TreeWriter {
    /// Makes the folders of the tree `folder` of all samples of `btf`.
    ///
    /// # Errors
    /// [`IoError`] if `folder` holds anything but images that this tree has too, or the system refuses to write.
    pub fn begin(folder: &Path, btf: &Btf, format: TreeFormat) -> Result<Self, IoError> {
        let extension = format.extension();
        let name = |sample: usize| {
            let (view, light) = btf.directions(sample);
            let ([tv, pv], [tl, pl]) = (degrees(view), degrees(light));
            (format!("tv{tv}_pv{pv}"), format!("{sample:05} tl{tl} pl{pl} tv{tv} pv{pv}.{extension}"))
        };
        let names: Vec<_> = (0..btf.pairs().len()).map(name).collect();
        let paths: BTreeSet<PathBuf> = names.iter().map(|(view, file)| folder.join(view).join(file)).collect();
        let views: BTreeSet<PathBuf> = names.iter().map(|(view, _)| folder.join(view)).collect();
        if let Some(foreign) = foreign(folder, &views, &paths)? {
            let found = format!("it also holds {}, which is no image of this tree", foreign.display());
            return Err(IoError::Occupied { path: folder.to_owned(), found });
        }
        for view in views {
            std::fs::create_dir_all(&view).map_err(|source| IoError::Write { path: view, source })?;
        }
        Ok(Self { folder: folder.to_owned(), format, size: btf.size(), names })
    }

    /// Writes `samples`, whose radiance is `[sample][channel][texel]`, on all cores. `done(n)` is told whenever n more are written.
    ///
    /// # Errors
    /// [`IoError`] if an image cannot be encoded or written.
    ///
    /// # Panics
    /// If there is no such sample, or `radiance` has another length.
    pub fn write(&self, samples: &[usize], radiance: &[f16], done: &(dyn Fn(usize) + Sync)) -> Result<Lost, IoError> {
        let texels = self.size[0] * self.size[1];
        assert_eq!(radiance.len(), samples.len() * 3 * texels, "the samples' radiance");
        let image = |(&sample, values): (&usize, &[f16])| {
            let (view, file) = &self.names[sample];
            let path = self.folder.join(view).join(file);
            let (bytes, lost) = encode(&path, self.format, self.size, values)?;
            super::write(&path, &bytes)?;
            done(1);
            Ok(lost)
        };
        samples.par_iter().zip(radiance.par_chunks_exact(3 * texels)).map(image).try_reduce(Lost::default, |a, b| Ok(a + b))
    }
}

/// θ and φ in degrees, three digits before the point and as many after it as are needed, to a millionth.
fn degrees(direction: Direction) -> [String; 2] {
    let (theta, phi) = direction.degrees();
    [theta, phi].map(|angle| {
        let text = format!("{angle:010.6}");
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    })
}

/// The first thing in `folder` that is neither hidden nor one of `views` nor in one of them one of `paths`.
fn foreign(folder: &Path, views: &BTreeSet<PathBuf>, paths: &BTreeSet<PathBuf>) -> Result<Option<PathBuf>, IoError> {
    if folder.symlink_metadata().is_err() {
        return Ok(None);
    }
    let entries = |folder: &Path| -> Result<Vec<PathBuf>, IoError> {
        let unreadable = |source| IoError::Read { file: folder.display().to_string(), source };
        let entries = std::fs::read_dir(folder).map_err(unreadable)?.map(|entry| entry.map(|entry| entry.path()));
        let mut entries = entries.collect::<Result<Vec<_>, _>>().map_err(unreadable)?;
        entries.retain(|entry| !entry.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.')));
        Ok(entries)
    };
    for entry in entries(folder)? {
        if !views.contains(&entry) || !entry.is_dir() {
            return Ok(Some(entry));
        }
        if let Some(inner) = entries(&entry)?.into_iter().find(|inner| !paths.contains(inner)) {
            return Ok(Some(inner));
        }
    }
    Ok(None)
}

/// The bytes of an image of `values`, `[channel][texel]`.
fn encode(path: &Path, format: TreeFormat, [width, height]: [usize; 2], values: &[f16]) -> Result<(Vec<u8>, Lost), IoError> {
    let failed = |message: String| IoError::Picture { path: path.to_owned(), message };
    let texels = width * height;
    let pixel = |texel: usize| [0, 1, 2].map(|channel| values[channel * texels + texel]);
    let mut bytes = Cursor::new(Vec::new());
    if format == TreeFormat::Exr {
        let channels = SpecificChannels::rgb(|Vec2(column, row)| <(f16, f16, f16)>::from(pixel(row * width + column)));
        Image::from_channels((width, height), channels).write().to_buffered(&mut bytes).map_err(|error| failed(error.to_string()))?;
        return Ok((bytes.into_inner(), Lost::default()));
    }
    let mut lost = Lost::default();
    let mut code = |value: f16| {
        let value = value.to_f64();
        lost.clipped += usize::from(value > 1.0 && value.is_finite());
        lost.invalid += usize::from(!value.is_finite() || value < 0.0);
        let held = if value.is_finite() { value.clamp(0.0, 1.0) } else { 0.0 };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "held to 0..=1 before")]
        let code = (255.0 * srgb_from_linear(held)).round() as u8;
        code
    };
    let codes: Vec<u8> = (0..texels).flat_map(pixel).map(&mut code).collect();
    let size = [width, height].map(u32::try_from);
    let [Ok(width), Ok(height)] = size else { return Err(failed("more than 2^32 rows or columns".to_owned())) };
    let encoded: Result<(), ImageError> = match format {
        TreeFormat::Jpeg(quality) => {
            JpegEncoder::new_with_quality(&mut bytes, quality).write_image(&codes, width, height, ExtendedColorType::Rgb8)
        }
        _ => PngEncoder::new(&mut bytes).write_image(&codes, width, height, ExtendedColorType::Rgb8),
    };
    encoded.map_err(|error| failed(error.to_string()))?;
    Ok((bytes.into_inner(), lost))
}
