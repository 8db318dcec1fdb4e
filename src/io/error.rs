//! What keeps a file from being read or written.

use std::path::PathBuf;

use super::{BtfFileError, MeshFileError, RecipeError, SelectionFault, lights::LightFault};
use crate::data::{BtfError, Direction, EnvironmentError, ShapeError, Transfer};

/// Everything that can go wrong with files. A `file` is a path, or an archive's path and the name inside it.
#[derive(Debug, thiserror::Error)]
pub enum IoError {
    /// Nothing has that name.
    #[error("{path} does not exist; check the spelling and the working folder", path = path.display())]
    NotFound {
        /// The path.
        path: PathBuf,
    },
    /// The system refused to read.
    #[error("cannot read {file} (check that it is there and that you may read it): {source}")]
    Read {
        /// The file or folder.
        file: String,
        /// Why.
        source: std::io::Error,
    },
    /// The system refused to write.
    #[error("cannot write {path} (check that its folder is there and may be written, and that the disk has room): {source}", path = path.display())]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },

    /// A source whose samples are computed, which failed.
    #[error("the samples of \"{name}\" could not be rendered: {source}")]
    NotRendered {
        /// Name of the source.
        name: String,
        /// Why.
        source: Box<dyn std::error::Error + Send + Sync>,
    },

    /// The unfinished work of another job.
    #[error(
        "an unfinished job for {target} stands in {folder} and differs from this one in: {differing}; run that job to its end, choose \
         another name, or remove the folder to start over",
        target = target.display(), folder = folder.display()
    )]
    OtherJob {
        /// What the job makes.
        target: PathBuf,
        /// Its work so far.
        folder: PathBuf,
        /// In what the two jobs differ.
        differing: String,
    },
    /// Another process makes the same target.
    #[error("another process is working on {target}; wait for it or choose another name", target = target.display())]
    Running {
        /// The target.
        target: PathBuf,
    },

    /// A file that is no archive.
    #[error("{path} is neither a folder nor a .zip archive: it starts with {found}; name a folder or a .zip of images", path = path.display())]
    NotAnArchive {
        /// The file.
        path: PathBuf,
        /// Its first bytes.
        found: String,
    },
    /// An archive that cannot be read as one.
    #[error("the archive {file} is damaged or of an unknown kind: {message}; copy it again, or unpack it and name the folder")]
    Archive {
        /// The archive, with the name inside it where one entry is concerned.
        file: String,
        /// What the zip reader found.
        message: String,
    },
    /// More bytes than an image of a BTF has.
    #[error("{file} holds {found} bytes, more than the {limit} that are read for one image; check the file")]
    TooManyBytes {
        /// The file.
        file: String,
        /// Bytes found or declared.
        found: u64,
        /// Bytes read at most.
        limit: u64,
    },

    /// A tree without images.
    #[error("no images in {path}: expected .jpg, .png, .bmp, .tif, .exr or .hdr files in it or its folders; name the folder or .zip that holds them", path = path.display())]
    NoImages {
        /// The folder or archive.
        path: PathBuf,
    },
    /// A tree of images whose names hold no directions.
    #[error(
        "none of the {images} images in {path} is named by its directions: expected names such as \"tl015 pl060 tv030 pv090.jpg\" \
         (θ and φ of light and view in degrees), found \"{first}\"; rename them, or add the light file (lights.txt, light_directions.txt or \
         an .lp)",
        path = path.display()
    )]
    NoDirections {
        /// The folder or archive.
        path: PathBuf,
        /// Number of images.
        images: usize,
        /// The first of them.
        first: String,
    },
    /// A direction at or below the horizon.
    #[error(
        "{file} names the direction {direction}, which is not above the surface: θ must be from 0 to below 90 degrees; correct the name or remove it"
    )]
    BelowHorizon {
        /// The file.
        file: String,
        /// The direction.
        direction: Direction,
    },
    /// The same view and light twice.
    #[error(
        "view {view}, light {light} is there twice: {first} and {second}; keep one (if they are of two materials, name the folder of one)"
    )]
    Repeated {
        /// The view.
        view: Direction,
        /// The light.
        light: Direction,
        /// One file.
        first: String,
        /// The other.
        second: String,
    },
    /// A known image format that is not read.
    #[error(
        "{file} is {found}; what is read is JPEG, PNG, BMP and TIFF of 8 or 16 bits, TIFF of floating-point numbers, Radiance HDR and OpenEXR: \
         convert it"
    )]
    Unsupported {
        /// The file.
        file: String,
        /// Its format.
        found: String,
    },
    /// Something else than an image.
    #[error(
        "{file} is no image: expected JPEG, PNG, BMP, TIFF, Radiance HDR or OpenEXR, found a file that starts with {found}; replace or remove it"
    )]
    NotAnImage {
        /// The file.
        file: String,
        /// Its first bytes.
        found: String,
    },
    /// An image that ends too early.
    #[error("{file} is truncated: its {bytes} bytes end before the image does; copy it again")]
    Truncated {
        /// The file.
        file: String,
        /// Bytes there are.
        bytes: usize,
    },
    /// An image with wrong contents.
    #[error("{file} is damaged: {message}; copy it again")]
    Damaged {
        /// The file.
        file: String,
        /// What the decoder found.
        message: String,
    },
    /// More texels than are read.
    #[error("{file} is {width} x {height} texels, more than the {limit} that are read for one image; crop it or reduce its size")]
    TooManyTexels {
        /// The file.
        file: String,
        /// Columns.
        width: usize,
        /// Rows.
        height: usize,
        /// Texels read at most.
        limit: usize,
    },
    /// Images of different sizes.
    #[error("{file} is {} x {} texels, but the tree's first image is {} x {}; all images of a material have one size: crop or replace it", found[0], found[1], expected[0], expected[1])]
    Size {
        /// The file.
        file: String,
        /// Its columns and rows.
        found: [usize; 2],
        /// Columns and rows of the tree's first image.
        expected: [usize; 2],
    },
    /// OpenEXR with unknown channels.
    #[error(
        "{file} has the channels {found}; what is read is R G B, X Y Z, Y alone, or one channel for each wavelength, named in nm such as 450nm: rename them"
    )]
    Channels {
        /// The file.
        file: String,
        /// Names of its channels.
        found: String,
    },
    /// Images of a tree that become radiance in different ways.
    #[error(
        "{file} holds {} values, but the tree's first image {}; convert it, or say what all of them hold (--transfer)",
        in_words(*found), in_words(*expected)
    )]
    OtherTransfer {
        /// The file.
        file: String,
        /// What its format has.
        found: Transfer,
        /// What the format of the tree's first image has.
        expected: Transfer,
    },
    /// An image of codes where radiance is needed.
    #[error(
        "{file} is an image of 8- or 16-bit codes, which end at white and leave lamps and sun out; expected linear radiance as floating-point \
         numbers: take the environment as Radiance HDR (.hdr) or OpenEXR (.exr)"
    )]
    NotAnEnvironment {
        /// The file.
        file: String,
    },
    /// An image whose values are no environment.
    #[error("{file}: {fault}")]
    Environment {
        /// The file.
        file: String,
        /// What is wrong.
        fault: EnvironmentError,
    },
    /// A light file that cannot be used.
    #[error("{file}: {fault}")]
    Lights {
        /// The light file.
        file: String,
        /// What is wrong.
        fault: LightFault,
    },
    /// More than one light file.
    #[error("{first} and {second} both list lights; name the .lp file that counts, or keep one in the folder")]
    LightFiles {
        /// One light file.
        first: String,
        /// Another.
        second: String,
    },
    /// A part that a source does not have.
    #[error(transparent)]
    Selection(#[from] SelectionFault),
    /// A description that is no BTF.
    #[error(transparent)]
    Btf(#[from] BtfError),
    /// A `.btf` container.
    #[error(transparent)]
    BtfFile(#[from] BtfFileError),
    /// A mesh.
    #[error(transparent)]
    Mesh(#[from] MeshFileError),
    /// A recipe or a library of paints.
    #[error(transparent)]
    Recipe(#[from] RecipeError),
    /// A recipe or a library of paints with more bytes than one has.
    #[error("{path} holds more than {limit} bytes, the most that are read of a recipe or a library of paints; check the name", path = path.display())]
    TooLongText {
        /// The file.
        path: PathBuf,
        /// Bytes read at most.
        limit: u64,
    },
    /// An image that is to be drawn in paint, with a pixel that says nothing.
    #[error("{file}: the pixel in column {column}, row {row} is not a number, and no thickness can be drawn from it; correct the image")]
    NoThickness {
        /// The image.
        file: String,
        /// Its column.
        column: usize,
        /// Its row.
        row: usize,
    },

    /// A folder that holds no material.
    #[error("{path} is no overpaint material: {found}; name a folder written by `overpaint fit`", path = path.display())]
    NotAMaterial {
        /// The folder.
        path: PathBuf,
        /// What was found instead.
        found: String,
    },
    /// A folder that holds no dataset.
    #[error("{path} is no overpaint dataset: {found}; name a folder written by `overpaint import`", path = path.display())]
    NotADataset {
        /// The folder.
        path: PathBuf,
        /// What was found instead.
        found: String,
    },
    /// A material or dataset of another version of its form.
    #[error("{path} has version {found} of the {what} format, this program reads version {expected}; use the program that wrote it, or make it again", path = path.display())]
    Version {
        /// The folder.
        path: PathBuf,
        /// "material" or "dataset".
        what: &'static str,
        /// Its version.
        found: String,
        /// The version read here.
        expected: u64,
    },
    /// One array of a material.
    #[error("array \"{array}\" of {path}: {fault}; fit the material again or restore it from a copy", path = path.display())]
    Array {
        /// The material.
        path: PathBuf,
        /// The array's name.
        array: &'static str,
        /// What is wrong with it.
        fault: ArrayFault,
    },
    /// One array of a dataset.
    #[error("array \"{array}\" of {path}: {fault}; check that the disk has room, restore it from a copy, or import it again", path = path.display())]
    Dataset {
        /// The dataset.
        path: PathBuf,
        /// The array's name.
        array: &'static str,
        /// What is wrong with it.
        fault: ArrayFault,
    },
    /// Encodings of a dataset, which has none.
    #[error("{path} is a dataset and holds radiance already: give transfer, cosine, rows and scale when it is imported", path = path.display())]
    AlreadyRadiance {
        /// The dataset.
        path: PathBuf,
    },
    /// A target that is not to be replaced.
    #[error("{path} is left as it is: {found}; choose another name, or move it away", path = path.display())]
    Occupied {
        /// The target.
        path: PathBuf,
        /// What stands there.
        found: String,
    },
    /// Maps that do not cover one plane.
    #[error(transparent)]
    Shape(#[from] ShapeError),

    /// A picture's name without a known extension.
    #[error("{path} must end in .png (sRGB, 8 bit) or .exr (linear, 32-bit float), found {found}; rename it", path = path.display())]
    Extension {
        /// The path.
        path: PathBuf,
        /// Its extension.
        found: String,
    },
    /// A pixel that has no 8-bit code.
    #[error("{path}: the pixel in column {column}, row {row} is not a number; write an .exr to look at the values", path = path.display())]
    NotANumber {
        /// The picture.
        path: PathBuf,
        /// Its column.
        column: usize,
        /// Its row.
        row: usize,
    },
    /// A `.glb` that would not know its own length.
    #[error("{path} would have {bytes} bytes, more than a .glb can; simplify the mesh, or name it .gltf", path = path.display())]
    TooLargeGlb {
        /// The file.
        path: PathBuf,
        /// Its bytes.
        bytes: usize,
    },
    /// A picture that cannot be encoded or decoded.
    #[error("picture {path}: {message}; check that the file is whole and what its extension says, or use the other of .png and .exr", path = path.display())]
    Picture {
        /// The picture.
        path: PathBuf,
        /// What the library found.
        message: String,
    },
}

fn in_words(transfer: Transfer) -> String {
    match transfer {
        Transfer::Srgb => "sRGB".to_owned(),
        Transfer::Gamma(gamma) => format!("gamma {gamma}"),
        Transfer::Linear => "linear".to_owned(),
    }
}

/// What is wrong with an array of a material.
#[derive(Debug, thiserror::Error)]
pub enum ArrayFault {
    /// A property that is not as the format has it.
    #[error("expected {what} {expected}, found {found}")]
    Unexpected {
        /// The property.
        what: &'static str,
        /// As the format has it.
        expected: String,
        /// As it is.
        found: String,
    },
    /// A chunk without a file.
    #[error("chunk {chunk} is missing")]
    MissingChunk {
        /// The chunk's key.
        chunk: String,
    },
    /// What the Zarr library found.
    #[error("cannot be read or written: {0}")]
    Zarr(String),
}
