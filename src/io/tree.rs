//! Trees of images named by their directions, as Bonn and Prague publish them: `00008 tl000 pl000 tv000 pv000.jpg`.
//!
//! The base name counts: it holds θ and φ of light and view in degrees (`tl`, `pl`, `tv`, `pv`), in any order, with or
//! without decimals, whatever stands between them. Folders and anything else in a name mean nothing. Hidden files are
//! left out.

use std::{collections::BTreeSet, sync::LazyLock};

use half::f16;
use rayon::prelude::*;
use regex::Regex;

use super::{IoError, ReadOptions, Source, archive::Archive, raster};
use crate::data::{Block, Btf, Direction, Encoding, Pair, RowOrder, Transfer};

/// Missing pairs that an error lists.
const LISTED: usize = 4;

/// Extensions of images, of those that are read and of those that are refused by name.
const EXTENSIONS: [&str; 8] = ["jpg", "jpeg", "png", "bmp", "tif", "tiff", "exr", "hdr"];

/// A direction in millionths of a degree, so that equal ones compare equal however they are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Angles {
    theta: i64,
    phi: i64,
}

impl Angles {
    const DEGREE: i64 = 1_000_000;

    fn direction(self) -> Direction {
        let degrees = |angle: i64| angle as f64 / Self::DEGREE as f64;
        Direction::from_degrees(degrees(self.theta), degrees(self.phi))
    }
}

/// One image: sorted by view, then light, θ before φ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Sample {
    view: Angles,
    light: Angles,
    /// Index into [`Archive::names`].
    file: usize,
}

/// A tree of 8-bit images, all pairs of its views and lights.
#[derive(Debug)]
pub(super) struct ImageTree {
    archive: Archive,
    btf: Btf,
    samples: Vec<Sample>,
}

impl ImageTree {
    /// Sorts the images by their directions, checks that every pair is there once, and reads the size of the first.
    pub(super) fn open(archive: Archive, options: &ReadOptions) -> Result<Self, IoError> {
        let images: Vec<usize> = (0..archive.names().len()).filter(|&file| extension(&archive.names()[file]).is_some()).collect();
        let mut samples: Vec<Sample> = images.iter().filter_map(|&file| sample(file, &archive.names()[file])).collect();
        let path = || archive.path().to_owned();
        let Some(&first) = images.first() else { return Err(IoError::NoImages { path: path() }) };
        if samples.is_empty() {
            return Err(IoError::NoDirections { path: path(), images: images.len(), first: archive.names()[first].clone() });
        }
        samples.sort_unstable();
        for sample in &samples {
            check(&archive, sample)?;
        }
        for pair in samples.windows(2) {
            if (pair[0].view, pair[0].light) == (pair[1].view, pair[1].light) {
                let (view, light) = (pair[0].view.direction(), pair[0].light.direction());
                return Err(IoError::Repeated { view, light, first: archive.label(pair[0].file), second: archive.label(pair[1].file) });
            }
        }
        let (views, lights) = product(&archive, &samples, images.len() - samples.len())?;

        let size = raster::size(&archive.label(samples[0].file), &archive.read(samples[0].file)?)?;
        let pairs = (0..views.len()).flat_map(|view| (0..lights.len()).map(move |light| Pair { view, light })).collect();
        let directions = |angles: Vec<Angles>| angles.into_iter().map(Angles::direction).collect();
        let btf = Btf::new(
            archive.stem(),
            size,
            directions(views),
            directions(lights),
            pairs,
            options.encoding(Encoding::photograph(Transfer::Srgb)),
        )?;
        Ok(Self { archive, btf, samples })
    }

    /// Whether any file is an image named by its directions.
    pub(super) fn has_samples(archive: &Archive) -> bool {
        archive.names().iter().any(|name| extension(name).is_some() && sample(0, name).is_some())
    }
}

impl Source for ImageTree {
    fn btf(&self) -> &Btf {
        &self.btf
    }

    fn read(&self, samples: &[usize], block: Block, radiance: &mut [f16], done: &(dyn Fn(usize) + Sync)) -> Result<(), IoError> {
        let (texels, [width, height]) = (block.texels(), self.btf.size());
        assert!(block.is_within([width, height]) && radiance.len() == 3 * samples.len() * texels, "the block and what it is read into");
        let encoding = self.btf.encoding();
        radiance.par_chunks_exact_mut(3 * texels).zip(samples).try_for_each(|(values, &sample)| {
            let file = self.samples[sample].file;
            let picture = raster::decode(&self.archive.label(file), &self.archive.read(file)?, [width, height])?;
            let factor = encoding.factor(self.btf.directions(sample).1);
            let radiance: Vec<f16> = (0..=255_u8).map(|code| f16::from_f64(factor * encoding.linear(f64::from(code) / 255.0))).collect();
            for (index, row) in block.rows().enumerate() {
                let stored = if encoding.rows == RowOrder::TopDown { row } else { height - 1 - row };
                for (at, pixel) in picture[stored * width..][block.columns()].iter().enumerate() {
                    for channel in 0..3 {
                        values[channel * texels + index * block.width + at] = radiance[usize::from(pixel[channel])];
                    }
                }
            }
            done(1);
            Ok(())
        })
    }

    fn fingerprint(&self) -> String {
        self.archive.fingerprint()
    }
}

/// The extension in lower case if it is an image's, unless the file is hidden.
fn extension(name: &str) -> Option<&'static str> {
    let base = name.rsplit('/').next().filter(|base| !base.starts_with('.'))?;
    let (_, extension) = base.rsplit_once('.')?;
    EXTENSIONS.into_iter().find(|known| known.eq_ignore_ascii_case(extension))
}

/// The directions in a base name, if each of the four angles is there exactly once.
fn sample(file: usize, name: &str) -> Option<Sample> {
    static ANGLE: LazyLock<Regex> =
        LazyLock::new(|| Regex::new(r"(?i)([tp])([lv])(-?[0-9]+(?:\.[0-9]+)?)").expect("the pattern is a constant"));
    let (stem, _) = name.rsplit('/').next()?.rsplit_once('.')?;
    let mut angles = [None; 4];
    for found in ANGLE.captures_iter(stem) {
        // A letter before it makes it part of a word.
        let start = found.get(0)?.start();
        if stem[..start].ends_with(|before: char| before.is_ascii_alphabetic()) {
            continue;
        }
        let slot = usize::from(found[2].eq_ignore_ascii_case("v")) * 2 + usize::from(found[1].eq_ignore_ascii_case("p"));
        let degrees: f64 = found[3].parse().ok()?;
        #[expect(clippy::cast_possible_truncation, reason = "saturates, far beyond any angle")]
        let angle = (degrees * Angles::DEGREE as f64).round() as i64;
        if angles[slot].replace(angle).is_some() {
            return None;
        }
    }
    let [Some(light_theta), Some(light_phi), Some(view_theta), Some(view_phi)] = angles else { return None };
    let turn = |phi: i64| phi.rem_euclid(360 * Angles::DEGREE);
    let (view, light) = (Angles { theta: view_theta, phi: turn(view_phi) }, Angles { theta: light_theta, phi: turn(light_phi) });
    Some(Sample { view, light, file })
}

/// Checks what a single name says.
fn check(archive: &Archive, sample: &Sample) -> Result<(), IoError> {
    for angles in [sample.view, sample.light] {
        if !(0..90 * Angles::DEGREE).contains(&angles.theta) {
            return Err(IoError::BelowHorizon { file: archive.label(sample.file), direction: angles.direction() });
        }
    }
    match extension(&archive.names()[sample.file]) {
        Some("exr") => Err(IoError::Unsupported { file: archive.label(sample.file), found: "OpenEXR".to_owned() }),
        Some("hdr") => Err(IoError::Unsupported { file: archive.label(sample.file), found: "Radiance HDR".to_owned() }),
        _ => Ok(()),
    }
}

/// The distinct views and lights of sorted samples, which must be all pairs of them.
fn product(archive: &Archive, samples: &[Sample], unnamed: usize) -> Result<(Vec<Angles>, Vec<Angles>), IoError> {
    let distinct = |angles: fn(&Sample) -> Angles| samples.iter().map(angles).collect::<BTreeSet<_>>().into_iter().collect::<Vec<_>>();
    let (views, lights) = (distinct(|sample| sample.view), distinct(|sample| sample.light));
    let missing = views.len() * lights.len() - samples.len();
    if missing == 0 {
        return Ok((views, lights));
    }
    let all = views.iter().flat_map(|&view| lights.iter().map(move |&light| (view, light)));
    let is_there = |pair: &(Angles, Angles)| samples.binary_search_by_key(pair, |sample| (sample.view, sample.light)).is_ok();
    let mut first: Vec<String> = all
        .filter(|pair| !is_there(pair))
        .take(LISTED)
        .map(|(view, light)| format!("view {}, light {}", view.direction(), light.direction()))
        .collect();
    if missing > LISTED {
        first.push("…".to_owned());
    }
    let unnamed =
        if unnamed == 0 { String::new() } else { format!(" ({unnamed} images have no directions in their names and do not count)") };
    Err(IoError::Missing {
        path: archive.path().to_owned(),
        views: views.len(),
        lights: lights.len(),
        missing,
        first: first.join("; "),
        unnamed,
    })
}
