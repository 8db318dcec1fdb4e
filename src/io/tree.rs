//! Trees of images named by their directions, as Bonn and Prague publish them: `00008 tl000 pl000 tv000 pv000.jpg`.
//!
//! Names are read as [`directions_in_name`](super::directions_in_name) says. Folders mean nothing, hidden files are left out, images whose
//! names hold no directions do not count. Not every view needs every light: the samples are the pairs that are there, by view, then light.

use std::collections::BTreeSet;

use super::{
    IoError, ReadOptions,
    archive::Archive,
    images::{Images, Shown, is_image},
    names::{Angles, angles},
};
use crate::data::Pair;

/// One image: sorted by view, then light, θ before φ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Sample {
    view: Angles,
    light: Angles,
    /// Index into [`Archive::names`].
    file: usize,
}

/// Whether any file is an image named by its directions.
pub(super) fn has_samples(archive: &Archive) -> bool {
    archive.names().iter().any(|name| is_image(name) && angles(name).is_some())
}

/// Sorts the images by their directions and checks that no pair is there twice.
pub(super) fn open(archive: Archive, options: &ReadOptions) -> Result<Images, IoError> {
    let images: Vec<usize> = (0..archive.names().len()).filter(|&file| is_image(&archive.names()[file])).collect();
    let Some(&first) = images.first() else { return Err(IoError::NoImages { path: archive.path().to_owned() }) };
    let mut samples: Vec<Sample> =
        images.iter().filter_map(|&file| angles(&archive.names()[file]).map(|(view, light)| Sample { view, light, file })).collect();
    if samples.is_empty() {
        let first = archive.names()[first].clone();
        return Err(IoError::NoDirections { path: archive.path().to_owned(), images: images.len(), first });
    }
    samples.sort_unstable();
    for sample in &samples {
        if let Some(angles) = [sample.view, sample.light].into_iter().find(|angles| !angles.is_above_horizon()) {
            return Err(IoError::BelowHorizon { file: archive.label(sample.file), direction: angles.direction() });
        }
    }
    for pair in samples.windows(2) {
        if (pair[0].view, pair[0].light) == (pair[1].view, pair[1].light) {
            let (view, light) = (pair[0].view.direction(), pair[0].light.direction());
            return Err(IoError::Repeated { view, light, first: archive.label(pair[0].file), second: archive.label(pair[1].file) });
        }
    }
    let distinct = |angles: fn(&Sample) -> Angles| samples.iter().map(angles).collect::<BTreeSet<_>>().into_iter().collect::<Vec<_>>();
    let (views, lights) = (distinct(|sample| sample.view), distinct(|sample| sample.light));
    let index = |directions: &[Angles], wanted| directions.partition_point(|direction| *direction < wanted);
    let pairs = samples.iter().map(|sample| Pair { view: index(&views, sample.view), light: index(&lights, sample.light) }).collect();
    let files = samples.iter().map(|sample| sample.file).collect();
    let directions = |angles: Vec<Angles>| angles.into_iter().map(Angles::direction).collect();
    let shown = Shown { pairs, files, views: directions(views), lights: directions(lights), mask: None, transfer: None };
    Images::open(archive, shown, options)
}
