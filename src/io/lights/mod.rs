//! Photographs from one view under calibrated lights: one `lights.txt`, `light_directions.txt` or `.lp` file says where the lights were.
//!
//! | file | images |
//! |---|---|
//! | `lights.txt` (Washington) | beside it, `name.0.png`, `name.1.png`, …: light k is the k-th of the list, from 0 |
//! | `light_directions.txt` (Harvard) | beside it, the k-th by name, numbers in names taken as numbers |
//! | `*.lp` (RTI) | those that it names, anywhere in the folder: by path, else by base name, else by base name without its extension, whatever the case |
//!
//! x points right, y up, z out of the surface. The view is the zenith. The images are linear. An image beside the light file that is called
//! `mask`, or whose name ends with `.mask`, `_mask` or `-mask`, says where the object is: other texels are NaN in every sample.
//!
//! Where images are named by their directions, a light file beside them does not count, unless it is an `.lp` that is named itself.

mod parse;

use std::collections::BTreeMap;

use regex::Regex;

pub use parse::{LightFault, parse_harvard, parse_lp, parse_uw};

use super::{
    IoError, ReadOptions,
    archive::Archive,
    images::{Images, Shown, base, is_image},
};
use crate::data::{Direction, Pair, Transfer};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Form {
    Washington,
    Harvard,
    Rti,
}

fn form(name: &str) -> Option<Form> {
    let base = base(name).to_lowercase();
    match base.as_str() {
        "lights.txt" => Some(Form::Washington),
        "light_directions.txt" => Some(Form::Harvard),
        _ if base.ends_with(".lp") && !base.starts_with('.') => Some(Form::Rti),
        _ => None,
    }
}

/// Whether there is a light file, and an image.
pub(super) fn has_lights(archive: &Archive) -> bool {
    archive.names().iter().any(|name| form(name).is_some()) && archive.names().iter().any(|name| is_image(name))
}

/// Reads the light file and finds the image of each light. `named` is the light file if somebody chose it.
pub(super) fn open(archive: Archive, named: Option<&str>, options: &ReadOptions) -> Result<Images, IoError> {
    let mut candidates = (0..archive.names().len()).filter_map(|file| {
        let name = &archive.names()[file];
        form(name).filter(|_| named.is_none_or(|named| named == name)).map(|form| (file, form))
    });
    let Some((file, form)) = candidates.next() else {
        return Err(IoError::NotFound { path: archive.path().join(named.unwrap_or_default()) });
    };
    if let Some((other, _)) = candidates.next() {
        return Err(IoError::LightFiles { first: archive.label(file), second: archive.label(other) });
    }
    let label = archive.label(file);
    let text = String::from_utf8_lossy(&archive.read(file)?).into_owned();
    let found = Beside::new(&archive, file);
    let shown = lights(form, &text, &archive, &found).and_then(|(lights, files)| Ok((lights, files, found.mask(&archive)?)));
    let (lights, files, mask) = shown.map_err(|fault| IoError::Lights { file: label, fault })?;
    let pairs = (0..lights.len()).map(|light| Pair { view: 0, light }).collect();
    let views = vec![Direction::from_degrees(0.0, 0.0)];
    Images::open(archive, Shown { views, lights, pairs, files, mask, transfer: Some(Transfer::Linear) }, options)
}

/// The images in a light file's folder.
struct Beside {
    masks: Vec<usize>,
    /// The others, by name.
    images: Vec<usize>,
}

impl Beside {
    fn new(archive: &Archive, file: usize) -> Self {
        let names = archive.names();
        let folder = &names[file][..names[file].len() - base(&names[file]).len()];
        let is_beside = |name: &str| is_image(name) && &name[..name.len() - base(name).len()] == folder;
        let is_mask = |file: &usize| {
            let stem = stem(base(&names[*file])).to_lowercase();
            stem.strip_suffix("mask").is_some_and(|rest| rest.is_empty() || rest.ends_with(['.', '_', '-']))
        };
        let (masks, mut images): (Vec<_>, Vec<_>) = (0..names.len()).filter(|&file| is_beside(&names[file])).partition(is_mask);
        images.sort_by_cached_key(|&file| by_numbers(&names[file]));
        Self { masks, images }
    }

    fn mask(&self, archive: &Archive) -> Result<Option<usize>, LightFault> {
        match self.masks.as_slice() {
            [] => Ok(None),
            [mask] => Ok(Some(*mask)),
            [first, second, ..] => Err(ambiguous("the mask", archive, *first, *second)),
        }
    }
}

/// The lights and their images.
fn lights(form: Form, text: &str, archive: &Archive, beside: &Beside) -> Result<(Vec<Direction>, Vec<usize>), LightFault> {
    let name = |file: usize| base(&archive.names()[file]).to_owned();
    match form {
        Form::Washington => {
            let lights = parse_uw(text)?;
            let mut numbered: BTreeMap<usize, usize> = BTreeMap::new();
            for &file in &beside.images {
                let Some(number) = number(&archive.names()[file]) else { continue };
                if let Some(other) = numbered.insert(number, file) {
                    return Err(ambiguous(&format!("image {number}"), archive, other, file));
                }
            }
            let example = numbered.first_key_value().map_or("name.0.png".to_owned(), |(_, file)| name(*file));
            let missing = |light: usize| LightFault::NoImage { light: light + 1, image: renumbered(&example, light) };
            let files: Vec<usize> =
                (0..lights.len()).map(|light| numbered.get(&light).copied().ok_or_else(|| missing(light))).collect::<Result<_, _>>()?;
            if numbered.len() > lights.len() {
                let (first, last) = (name(files[0]), numbered.last_key_value().map_or(String::new(), |(_, file)| name(*file)));
                return Err(LightFault::ImageCount { lights: lights.len(), images: numbered.len(), first, last });
            }
            Ok((lights, files))
        }
        Form::Harvard => {
            let lights = parse_harvard(text)?;
            if beside.images.len() == lights.len() {
                return Ok((lights, beside.images.clone()));
            }
            let at = |file: Option<&usize>| file.map_or("none".to_owned(), |file| name(*file));
            let (first, last) = (at(beside.images.first()), at(beside.images.last()));
            Err(LightFault::ImageCount { lights: lights.len(), images: beside.images.len(), first, last })
        }
        Form::Rti => {
            let listed = parse_lp(text)?;
            let images = ByName::new(archive);
            let files: Vec<usize> =
                listed.iter().enumerate().map(|(light, (image, _))| images.find(archive, light, image)).collect::<Result<_, _>>()?;
            let mut claimed = BTreeMap::new();
            for (light, &file) in files.iter().enumerate() {
                if let Some(first) = claimed.insert(file, light) {
                    return Err(LightFault::Shared { first: first + 1, second: light + 1, image: name(file) });
                }
            }
            Ok((listed.into_iter().map(|(_, direction)| direction).collect(), files))
        }
    }
}

/// Images by what a light file may call them, in lower case.
struct ByName {
    paths: BTreeMap<String, Vec<usize>>,
    bases: BTreeMap<String, Vec<usize>>,
    stems: BTreeMap<String, Vec<usize>>,
}

impl ByName {
    fn new(archive: &Archive) -> Self {
        let mut images = Self { paths: BTreeMap::new(), bases: BTreeMap::new(), stems: BTreeMap::new() };
        for (file, name) in archive.names().iter().enumerate().filter(|(_, name)| is_image(name)) {
            let path = name.to_lowercase();
            images.stems.entry(stem(base(&path)).to_owned()).or_default().push(file);
            images.bases.entry(base(&path).to_owned()).or_default().push(file);
            images.paths.entry(path).or_default().push(file);
        }
        images
    }

    fn find(&self, archive: &Archive, light: usize, image: &str) -> Result<usize, LightFault> {
        let path = image.replace('\\', "/").to_lowercase();
        let relative = path.trim_start_matches("./");
        let found = self.paths.get(relative).or_else(|| self.bases.get(base(&path))).or_else(|| self.stems.get(stem(base(&path))));
        match found.map(Vec::as_slice) {
            Some([file]) => Ok(*file),
            Some([first, second, ..]) => Err(ambiguous(&format!("the image {image} of light {}", light + 1), archive, *first, *second)),
            _ => Err(LightFault::NoImage { light: light + 1, image: image.to_owned() }),
        }
    }
}

fn ambiguous(what: &str, archive: &Archive, first: usize, second: usize) -> LightFault {
    LightFault::Ambiguous { what: what.to_owned(), first: archive.names()[first].clone(), second: archive.names()[second].clone() }
}

/// A base name without its extension.
fn stem(base: &str) -> &str {
    base.rsplit_once('.').map_or(base, |(stem, _)| stem)
}

/// The number K of `name.K.png`.
fn number(name: &str) -> Option<usize> {
    let (_, number) = stem(base(name)).rsplit_once('.')?;
    number.bytes().all(|byte| byte.is_ascii_digit()).then(|| number.parse().ok())?
}

/// `name.K.png` with another number.
fn renumbered(name: &str, number: usize) -> String {
    let extension = &name[stem(name).len()..];
    let object = stem(name).rsplit_once('.').map_or(name, |(object, _)| object);
    format!("{object}.{number}{extension}")
}

/// A key that sorts numbers in a name as numbers.
fn by_numbers(name: &str) -> String {
    let digits = Regex::new("[0-9]+").expect("the pattern is a constant");
    digits.replace_all(name, |found: &regex::Captures<'_>| format!("{:0>20}", &found[0])).into_owned()
}
