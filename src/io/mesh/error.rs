//! What keeps a file from being read as a mesh.

use crate::data::MeshError;

/// A fault of a mesh with the file it is in.
#[derive(Debug, thiserror::Error)]
#[error("{file}: {fault}")]
pub struct MeshFileError {
    /// The file.
    pub file: String,
    /// What is wrong.
    pub fault: MeshFault,
}

/// What is wrong.
#[derive(Debug, thiserror::Error)]
pub enum MeshFault {
    /// A name without a known extension.
    #[error("a mesh must end in .obj, .gltf or .glb, found {found}; convert it, or name the file for what it is")]
    Extension {
        /// The extension.
        found: String,
    },
    /// More bytes than are read.
    #[error("it holds more than {limit} bytes, the most that are read of a mesh; simplify the mesh")]
    TooManyBytes {
        /// Bytes read at most.
        limit: u64,
    },
    /// More of something than a mesh may have.
    #[error("it has {found} {what}, more than the {most} that are read; simplify the mesh")]
    TooMany {
        /// "vertices" or "triangles".
        what: &'static str,
        /// Number of them, or of those until there were too many.
        found: usize,
        /// The largest number.
        most: usize,
    },
    /// No surface at all.
    #[error("it has no triangle with an area; export the surface as triangles or polygons")]
    Empty,
    /// A line of an OBJ.
    #[error("line {line}: expected {expected}, found \"{found}\"; correct the line or export the mesh again")]
    Line {
        /// The line, from 1.
        line: usize,
        /// What it should be.
        expected: &'static str,
        /// What it is.
        found: String,
    },
    /// A corner of a face of an OBJ that is not there.
    #[error(
        "line {line}: a face names {what} {found}, but {there} are numbered from 1 up to this line and {all} in all; export the mesh again"
    )]
    Corner {
        /// The line, from 1.
        line: usize,
        /// "vertex", "texture coordinate" or "normal".
        what: &'static str,
        /// The number.
        found: isize,
        /// How many there are before the line.
        there: usize,
        /// How many there are.
        all: usize,
    },
    /// What a library found.
    #[error("it cannot be read: {message}; export the mesh again, or look at the file with a validator")]
    Damaged {
        /// What it found.
        message: String,
    },
    /// A feature that is not read.
    #[error("it needs {found}, which is not read; export the mesh without it")]
    Unsupported {
        /// The feature.
        found: String,
    },
    /// A buffer of a glTF that cannot be had.
    #[error("buffer {buffer}: expected {expected}, found {found}; put the file in its place, or export the mesh as one .glb")]
    Buffer {
        /// The buffer, from 0.
        buffer: usize,
        /// What it should be.
        expected: String,
        /// What it is.
        found: String,
    },
    /// An array of a glTF.
    #[error("the {what} of mesh {mesh}: expected {expected}, found {found}; export the mesh again")]
    Array {
        /// "POSITION", "NORMAL", "indices", …
        what: &'static str,
        /// Name or number of the mesh.
        mesh: String,
        /// What it should be.
        expected: String,
        /// What it is.
        found: String,
    },
    /// Nodes that are not a tree.
    #[error("node {node} is reached in two ways, but nodes must be a tree; export the mesh again")]
    NotATree {
        /// The node, from 0.
        node: usize,
    },
    /// Values that are no mesh.
    #[error("{0}")]
    Mesh(#[from] MeshError),
}
