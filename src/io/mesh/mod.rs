//! Meshes: Wavefront OBJ, and glTF 2.0 as `.gltf` or `.glb`.
//!
//! A file's objects become one [`Mesh`] in the file's own axes and unit; materials, cameras, lights and animations do not count.
//!
//! | missing | made |
//! |---|---|
//! | normals | smooth: the mean of the faces that meet at a place, weighted by their angles there (Thürmer and Wüthrich 1998) |
//! | texture coordinates | box projection: each triangle by the axis its normal is nearest to; four pieces of the material over the largest extent |
//! | tangents | MikkTSpace, see [`Mesh::with_tangents`] |
//!
//! Normals that are there but have no length are made as those that are missing. Triangles without an area are left out, and those whose
//! corners run clockwise, seen from where their normals point, are turned. Each of these, but for the tangents, is said in a warning.
//!
//! Texture coordinates: v runs up in an OBJ, as here; in a glTF it runs down, and 1 - v is taken. Tangents of a glTF are for the image as it
//! is seen, y up, as those here are, and are kept.

mod complete;
mod error;
mod gltf;
mod obj;

use std::{fs::File, io::Read, path::Path};

pub use error::{MeshFault, MeshFileError};

use super::IoError;
use crate::data::Mesh;

/// The most bytes of a file, and of the buffers of a glTF.
const MAX_BYTES: u64 = 1 << 30;

/// A mesh from a file.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadedMesh {
    /// The mesh.
    pub mesh: Mesh,
    /// What was made or left out, a sentence each.
    pub warnings: Vec<String>,
}

/// The formats of meshes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeshFormat {
    /// Wavefront OBJ.
    Obj,
    /// glTF 2.0, as JSON or binary; the first bytes tell which.
    Gltf,
}

impl MeshFormat {
    /// The format of a file by its extension.
    #[must_use]
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_ascii_lowercase().to_str()? {
            "obj" => Some(Self::Obj),
            "gltf" | "glb" => Some(Self::Gltf),
            _ => None,
        }
    }
}

/// Reads a mesh, with the buffers beside it.
///
/// # Errors
/// [`IoError::NotFound`] or [`IoError::Read`] if the file cannot be read, [`IoError::Mesh`] if it is no mesh.
pub fn load(path: &Path) -> Result<LoadedMesh, IoError> {
    let file = path.display().to_string();
    let Some(format) = MeshFormat::of(path) else {
        let found = path.extension().map_or("none".to_owned(), |extension| format!(".{}", extension.display()));
        return Err(MeshFileError { file, fault: MeshFault::Extension { found } }.into());
    };
    let bytes = match read(path, MAX_BYTES + 1) {
        Ok(bytes) if bytes.len() as u64 > MAX_BYTES => {
            return Err(MeshFileError { file, fault: MeshFault::TooManyBytes { limit: MAX_BYTES } }.into());
        }
        Ok(bytes) => bytes,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Err(IoError::NotFound { path: path.to_owned() }),
        Err(source) => return Err(IoError::Read { file, source }),
    };
    Ok(parse(&file, &bytes, format, path.parent().unwrap_or(Path::new("")))?)
}

/// Reads the bytes of a mesh called `file`, whose names of other files start from `folder`.
///
/// # Errors
/// [`MeshFileError`] if they are no mesh, or a buffer cannot be read.
pub fn parse(file: &str, bytes: &[u8], format: MeshFormat, folder: &Path) -> Result<LoadedMesh, MeshFileError> {
    let mut warnings = Vec::new();
    let parts = match format {
        MeshFormat::Obj => obj::parts(bytes),
        MeshFormat::Gltf => gltf::parts(bytes, folder, &mut warnings),
    };
    let mesh = parts.and_then(|parts| complete::mesh(parts, &mut warnings));
    mesh.map(|mesh| LoadedMesh { mesh, warnings }).map_err(|fault| MeshFileError { file: file.to_owned(), fault })
}

/// The first bytes of a file.
fn read(path: &Path, most: u64) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(path)?.take(most).read_to_end(&mut bytes)?;
    Ok(bytes)
}
