//! Light files as text.

use glam::DVec3;

use crate::data::Direction;

/// A unit vector may be this much longer or shorter than 1.
const TOLERANCE: f64 = 0.1;

/// What is wrong with a light file or with the images that it speaks of.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LightFault {
    /// Nothing in it.
    #[error("it lists no lights")]
    Empty,
    /// The first line is no count.
    #[error("line {line}: expected the number of lights, found \"{found}\"")]
    NoCount {
        /// The line, from 1.
        line: usize,
        /// What stands there.
        found: String,
    },
    /// Another number of lights than the first line says.
    #[error("its first line says {declared} lights, but {found} follow; correct the number or the list")]
    Count {
        /// What the first line says.
        declared: usize,
        /// What follows.
        found: usize,
    },
    /// A line of another form.
    #[error("line {line}: expected {expected}, found \"{found}\"")]
    Line {
        /// The line, from 1.
        line: usize,
        /// What is expected there.
        expected: &'static str,
        /// What stands there.
        found: String,
    },
    /// Not three rows.
    #[error("expected three rows, of x, y and z, with a column for each light, found {found} rows")]
    Rows {
        /// Rows found.
        found: usize,
    },
    /// Rows of different lengths.
    #[error("line {line}: expected {expected} numbers as in the first row, found {found}")]
    Columns {
        /// The line, from 1.
        line: usize,
        /// Numbers in the first row.
        expected: usize,
        /// Numbers in this one.
        found: usize,
    },
    /// Numbers that are no direction of light.
    #[error(
        "{place}: the light's direction {x} {y} {z} {problem}; expected a unit vector that points from the surface to the light, z > 0"
    )]
    Direction {
        /// Line or column.
        place: String,
        /// To the right.
        x: f64,
        /// Up.
        y: f64,
        /// Out of the surface.
        z: f64,
        /// What is wrong with it.
        problem: &'static str,
    },
    /// A light without an image.
    #[error("light {light} belongs to the image {image}, which is not there; add it or take the light off the list")]
    NoImage {
        /// The light, from 1.
        light: usize,
        /// Name of its image.
        image: String,
    },
    /// Two images where one is expected.
    #[error("{what} may be {first} or {second}; keep one of them")]
    Ambiguous {
        /// What is looked for.
        what: String,
        /// One image.
        first: String,
        /// The other.
        second: String,
    },
    /// An image that two lights claim.
    #[error("lights {first} and {second} belong to one image, {image}; each light has an image of its own")]
    Shared {
        /// One light, from 1.
        first: usize,
        /// The other.
        second: usize,
        /// The image.
        image: String,
    },
    /// As many images as lights are expected.
    #[error("it lists {lights} lights, but beside it are {images} images ({first} to {last}); light k belongs to the k-th image by name")]
    ImageCount {
        /// Lights in the file.
        lights: usize,
        /// Images beside it.
        images: usize,
        /// The first of them, if any.
        first: String,
        /// The last of them, if any.
        last: String,
    },
}

/// Reads a `lights.txt` as the University of Washington writes it: the number of lights, then one `x y z` a line.
///
/// # Errors
/// [`LightFault`] if it has another form, the number is wrong, or a vector is no direction above the surface.
pub fn parse_uw(text: &str) -> Result<Vec<Direction>, LightFault> {
    let mut lines = lines(text);
    let declared = count(lines.next())?;
    let lights = lines.map(|(line, text)| direction(&format!("line {line}"), vector(line, text, "a vector x y z")?));
    counted(declared, lights.collect::<Result<_, _>>()?)
}

/// Reads a `light_directions.txt` as Harvard writes it: three rows, x, y and z, with a column for each light.
///
/// # Errors
/// As [`parse_uw`].
pub fn parse_harvard(text: &str) -> Result<Vec<Direction>, LightFault> {
    let mut rows: Vec<Vec<f64>> = Vec::new();
    for (line, text) in lines(text) {
        let row: Option<Vec<f64>> = text.split_whitespace().map(|word| word.parse().ok()).collect();
        let row = row.ok_or_else(|| LightFault::Line { line, expected: "a row of numbers", found: shortened(text) })?;
        if let Some(first) = rows.first().filter(|first| first.len() != row.len()) {
            return Err(LightFault::Columns { line, expected: first.len(), found: row.len() });
        }
        rows.push(row);
    }
    match rows.as_slice() {
        [] => Err(LightFault::Empty),
        [x, y, z] => {
            let vectors = x.iter().zip(y).zip(z).map(|((&x, &y), &z)| DVec3 { x, y, z });
            vectors.enumerate().map(|(index, vector)| direction(&format!("column {}", index + 1), vector)).collect()
        }
        other => Err(LightFault::Rows { found: other.len() }),
    }
}

/// Reads an RTI `.lp` file: the number of lights, then one `file x y z` a line. File names may have spaces, and quotes around them.
///
/// # Errors
/// As [`parse_uw`].
pub fn parse_lp(text: &str) -> Result<Vec<(String, Direction)>, LightFault> {
    let mut lines = lines(text);
    let declared = count(lines.next())?;
    let lights = lines.map(|(line, text)| {
        let expected = "an image's name and a vector x y z";
        let without_last = |text: &'_ str| text.trim_end().rsplit_once(char::is_whitespace).map_or(0, |(rest, _)| rest.trim_end().len());
        let file = &text[..(0..3).fold(text.len(), |end, _| without_last(&text[..end]))];
        let vector = vector(line, &text[file.len()..], expected)?;
        let file = file.trim_matches('"');
        if file.is_empty() {
            return Err(LightFault::Line { line, expected, found: shortened(text) });
        }
        Ok((file.to_owned(), direction(&format!("line {line}"), vector)?))
    });
    counted(declared, lights.collect::<Result<_, _>>()?)
}

/// Lines that are not empty, with their numbers from 1.
fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    text.lines().map(str::trim).enumerate().map(|(index, line)| (index + 1, line)).filter(|(_, line)| !line.is_empty())
}

fn count(line: Option<(usize, &str)>) -> Result<usize, LightFault> {
    let (line, text) = line.ok_or(LightFault::Empty)?;
    text.parse().map_err(|_| LightFault::NoCount { line, found: shortened(text) })
}

fn counted<T>(declared: usize, lights: Vec<T>) -> Result<Vec<T>, LightFault> {
    if lights.len() != declared {
        return Err(LightFault::Count { declared, found: lights.len() });
    }
    if lights.is_empty() { Err(LightFault::Empty) } else { Ok(lights) }
}

fn vector(line: usize, text: &str, expected: &'static str) -> Result<DVec3, LightFault> {
    let numbers: Option<Vec<f64>> = text.split_whitespace().map(|word| word.parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[x, y, z]) => Ok(DVec3 { x, y, z }),
        _ => Err(LightFault::Line { line, expected, found: shortened(text) }),
    }
}

fn direction(place: &str, vector: DVec3) -> Result<Direction, LightFault> {
    let direction = Direction::from_vector(vector);
    let problem = if !vector.is_finite() {
        "is not finite"
    } else if vector == DVec3::ZERO {
        "is zero"
    } else if (vector.length() - 1.0).abs() > TOLERANCE {
        "has another length than 1"
    } else if direction.theta >= std::f64::consts::FRAC_PI_2 {
        "is not above the surface"
    } else {
        return Ok(direction);
    };
    let DVec3 { x, y, z } = vector;
    Err(LightFault::Direction { place: place.to_owned(), x, y, z, problem })
}

/// The start of a line, for a message.
fn shortened(text: &str) -> String {
    text.chars().take(60).collect()
}
