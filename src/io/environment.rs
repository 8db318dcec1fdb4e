//! Environment maps: Radiance HDR and OpenEXR, equirectangular as [`Environment`] says.
//!
//! Floating-point TIFF is taken, too. Images of integers are refused: their codes end at white, and a lamp is no brighter than paper in them.
//!
//! An infinite value is a sun that did not fit into a half float, and becomes the largest, 65504; a negative one is the ringing of a filter
//! beside such a sun, and becomes 0. Both are said in a warning. NaN says nothing about what was there, and is refused.

use std::{fs::File, path::Path};

use super::{
    IoError, archive,
    raster::{self, Picture},
};
use crate::data::{Environment, Map, Transfer};

/// What an infinite value becomes: the largest half float.
const OVERFLOW: f32 = 65504.0;

/// An environment from a file.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadedEnvironment {
    /// The environment.
    pub environment: Environment,
    /// What was mended, a sentence each.
    pub warnings: Vec<String>,
}

/// Reads an environment map. The format is told by the content.
///
/// # Errors
/// [`IoError`] if the file cannot be read, is of another format or damaged, is too large, or holds NaN.
pub fn load(path: &Path) -> Result<LoadedEnvironment, IoError> {
    let file = path.display().to_string();
    let unreadable = |source: std::io::Error| match source.kind() {
        std::io::ErrorKind::NotFound => IoError::NotFound { path: path.to_owned() },
        _ => IoError::Read { file: file.clone(), source },
    };
    let reader = File::open(path).map_err(unreadable)?;
    let declared = reader.metadata().map_err(unreadable)?.len();
    let bytes = archive::bounded(&file, declared, reader).map_err(unreadable)??;
    parse(&file, &bytes)
}

/// Reads the bytes of an environment map called `file`.
///
/// # Errors
/// As [`load`].
pub fn parse(file: &str, bytes: &[u8]) -> Result<LoadedEnvironment, IoError> {
    let header = raster::header(file, bytes)?;
    if header.transfer != Transfer::Linear {
        return Err(IoError::NotAnEnvironment { file: file.to_owned() });
    }
    let invalid = |fault| IoError::Environment { file: file.to_owned(), fault };
    let [width, height] = header.size;
    Environment::check_size(header.size).map_err(invalid)?;
    let Picture::Floats(mut values) = raster::decode(file, bytes, header.size)? else {
        return Err(IoError::NotAnEnvironment { file: file.to_owned() });
    };
    let (mut infinite, mut negative) = (0, 0);
    for value in &mut values {
        if *value == f32::INFINITY {
            *value = OVERFLOW;
            infinite += 1;
        } else if *value < 0.0 {
            *value = 0.0;
            negative += 1;
        }
    }
    let mut warnings = Vec::new();
    if infinite > 0 {
        warnings.push(format!("{file}: {infinite} values are infinite and were taken as {OVERFLOW}, the largest half float"));
    }
    if negative > 0 {
        warnings.push(format!("{file}: {negative} values are negative and were taken as 0"));
    }
    let texels = values.chunks_exact(3).map(|rgb| [rgb[0], rgb[1], rgb[2]]).collect();
    let environment = Environment::new(Map::new(width, height, texels)?).map_err(invalid)?;
    Ok(LoadedEnvironment { environment, warnings })
}
