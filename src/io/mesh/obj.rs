//! Wavefront OBJ, by the crate `tobj`.
//!
//! The crate computes with the numbers of a face's corners before it checks them, reads lines (`l`) as faces, and misplaces normals and
//! texture coordinates that only some faces of an object have. So it is given a text in which each number has been checked, with nothing in
//! it but positions, normals, texture coordinates and faces, and with a new object wherever faces change what they have. Polygons become
//! fans of triangles. Smoothing groups do not count.

use std::{borrow::Cow, fmt::Write};

use tobj::{LoadOptions, Mesh};

use super::{MeshFault, complete::Part};
use crate::{data::mesh::MAX_VERTICES, io::recipe::shortened};

/// Numbers that a corner may have: of its position, texture coordinates and normal.
const NAMES: [&str; 3] = ["vertex", "texture coordinate", "normal"];

/// The parts of a file: runs of faces that have the same.
pub(super) fn parts(bytes: &[u8]) -> Result<Vec<Part>, MeshFault> {
    let text = checked(&String::from_utf8_lossy(bytes))?;
    let options = LoadOptions { triangulate: true, single_index: true, ..LoadOptions::default() };
    let (models, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, |_| Err(tobj::LoadError::GenericFailure))
        .map_err(|error| MeshFault::Damaged { message: error.to_string() })?;
    Ok(models.into_iter().map(|model| part(&model.mesh)).collect())
}

fn part(mesh: &Mesh) -> Part {
    let some = |has: bool| has.then_some(());
    Part {
        positions: grouped(&mesh.positions),
        normals: some(!mesh.normals.is_empty()).map(|()| grouped(&mesh.normals)),
        texture_coordinates: some(!mesh.texcoords.is_empty()).map(|()| grouped(&mesh.texcoords)),
        tangents: None,
        triangles: grouped(&mesh.indices),
    }
}

fn grouped<T: Copy, const N: usize>(values: &[T]) -> Vec<[T; N]> {
    values.as_chunks().0.to_vec()
}

/// What is read of the file, checked.
fn checked(text: &str) -> Result<String, MeshFault> {
    let mut checked = String::new();
    let all = counted(text);
    let mut there = [0; 3];
    let mut triangles = 0;
    let mut has = None;
    for (line, text) in lines(text) {
        let mut words = text.split_whitespace();
        let fault = |expected| MeshFault::Line { line, expected, found: shortened(text.trim()) };
        match words.next() {
            Some("v") => numbers::<3>("v", words, &mut checked).ok_or_else(|| fault("three finite numbers after v"))?,
            Some("vt") => numbers::<2>("vt", words, &mut checked).ok_or_else(|| fault("two finite numbers after vt"))?,
            Some("vn") => numbers::<3>("vn", words, &mut checked).ok_or_else(|| fault("three finite numbers after vn"))?,
            Some("f") => {
                let corners = words.map(corner).collect::<Option<Vec<_>>>();
                let corners = corners.filter(|corners| corners.len() > 2).ok_or_else(|| {
                    fault("three or more corners after f, each such as 1, 1/2, 1/2/3 or 1//3 with whole numbers other than 0")
                })?;
                let given = corners[0].map(|number| number.is_some());
                if corners.iter().any(|corner| corner.map(|number| number.is_some()) != given) {
                    return Err(fault("corners that all have the same of position, texture coordinates and normal"));
                }
                triangles += corners.len() - 2;
                if triangles > MAX_VERTICES {
                    return Err(MeshFault::TooMany { what: "triangles", found: triangles, most: MAX_VERTICES });
                }
                if has.replace(given) != Some(given) {
                    checked.push_str("o part\n");
                }
                checked.push('f');
                for corner in corners {
                    write_corner(corner, line, there, all, &mut checked)?;
                }
                checked.push('\n');
            }
            _ => {}
        }
        if let Some(kind) = kind(&text) {
            there[kind] += 1;
        }
    }
    Ok(checked)
}

/// The file's lines, one that ends with a backslash joined with the next, and their numbers from 1.
fn lines(text: &str) -> impl Iterator<Item = (usize, Cow<'_, str>)> {
    let mut lines = (1..).zip(text.lines());
    std::iter::from_fn(move || {
        let (number, line) = lines.next()?;
        let mut line = Cow::Borrowed(line);
        while let Some(start) = line.trim_end().strip_suffix('\\') {
            let rest = lines.next().map_or("", |(_, rest)| rest);
            line = Cow::Owned(format!("{start} {rest}"));
        }
        Some((number, line))
    })
}

/// Which of the numbers of a corner a line counts for.
fn kind(line: &str) -> Option<usize> {
    ["v", "vt", "vn"].iter().position(|kind| line.split_whitespace().next() == Some(kind))
}

/// How many positions, texture coordinates and normals there are.
fn counted(text: &str) -> [usize; 3] {
    let mut counts = [0; 3];
    for kind in lines(text).filter_map(|(_, line)| kind(&line)) {
        counts[kind] += 1;
    }
    counts
}

/// Writes the first N of the words if they are finite numbers.
fn numbers<'a, const N: usize>(key: &str, mut words: impl Iterator<Item = &'a str>, checked: &mut String) -> Option<()> {
    checked.push_str(key);
    for _ in 0..N {
        let word = words.next()?;
        word.parse::<f32>().ok().filter(|number| number.is_finite())?;
        checked.push(' ');
        checked.push_str(word);
    }
    checked.push('\n');
    Some(())
}

/// The numbers of a corner, none of which is 0.
fn corner(word: &str) -> Option<[Option<isize>; 3]> {
    let mut numbers = [None; 3];
    for (index, number) in word.split('/').enumerate() {
        let place = numbers.get_mut(index)?;
        if !number.is_empty() {
            *place = Some(number.parse().ok().filter(|number| *number != 0)?);
        }
    }
    numbers[0].map(|_| numbers)
}

/// Writes a corner's numbers, counted from the first.
fn write_corner(
    corner: [Option<isize>; 3], line: usize, there: [usize; 3], all: [usize; 3], checked: &mut String,
) -> Result<(), MeshFault> {
    for (kind, number) in corner.into_iter().enumerate() {
        checked.push(if kind == 0 { ' ' } else { '/' });
        let Some(found) = number else { continue };
        // A negative number counts back from the line.
        let absolute = if found < 0 { (there[kind] + 1).checked_sub(found.unsigned_abs()) } else { Some(found.unsigned_abs()) };
        let absolute = absolute.filter(|absolute| (1..=all[kind]).contains(absolute));
        let absolute = absolute.ok_or(MeshFault::Corner { line, what: NAMES[kind], found, there: there[kind], all: all[kind] })?;
        write!(checked, "{absolute}").ok();
    }
    Ok(())
}
