//! What keeps a `.btf` container from being read.

/// Everything that can be wrong with a `.btf` container.
#[derive(Debug, thiserror::Error)]
pub enum BtfFileError {
    /// The system failed to read.
    #[error("cannot read {bytes} bytes at byte {offset} of {file} (check the disk, and that nothing writes the file): {source}")]
    Read {
        /// The file.
        file: String,
        /// Where.
        offset: u64,
        /// How much.
        bytes: usize,
        /// Why.
        source: std::io::Error,
    },
    /// A file without a container's signature.
    #[error("{file} is no .btf container that is read here: expected one of {expected} at byte 0, found {found}; check what it is")]
    Signature {
        /// The file.
        file: String,
        /// The signatures that are known.
        expected: String,
        /// Its first bytes.
        found: String,
    },
    /// A header that declares more than there is.
    #[error(
        "{file} ends too early: at byte {offset}, {what} needs {expected} bytes, {found} are left; it is truncated or damaged, copy it again"
    )]
    TooShort {
        /// The file.
        file: String,
        /// Where it would start.
        offset: u64,
        /// What would be there.
        what: &'static str,
        /// Bytes it needs.
        expected: u64,
        /// Bytes to the end of the file.
        found: u64,
    },
    /// A header whose sizes multiply to more than any file has.
    #[error(
        "{file} is damaged: at byte {offset}, {what} is declared as {found} bytes, more than a file or this machine can hold; copy it again"
    )]
    TooLarge {
        /// The file.
        file: String,
        /// Where it would start.
        offset: u64,
        /// What would be there.
        what: &'static str,
        /// The factors of its size.
        found: String,
    },
    /// A field with a value that it cannot have.
    #[error(
        "{file} is damaged, or not as this program knows the format: at byte {offset}, expected {what} {expected}, found {found}; copy it again"
    )]
    Unexpected {
        /// The file.
        file: String,
        /// Where it is.
        offset: u64,
        /// The field.
        what: &'static str,
        /// As the format has it.
        expected: String,
        /// As it is.
        found: String,
    },
    /// A known or new kind of contents that is not read.
    #[error("{file} is not read: at byte {offset}, {what} is {found}, {expected} can be read; convert it with the tools of its publisher")]
    Unsupported {
        /// The file.
        file: String,
        /// Where it says so.
        offset: u64,
        /// The property.
        what: &'static str,
        /// What is read.
        expected: &'static str,
        /// As it is.
        found: String,
    },
    /// A direction that is none, or at or below the horizon.
    #[error(
        "{file}: at byte {offset}, {what} {index} is θ {theta}, φ {phi} radians: θ must be from 0 to below π/2 and φ a number; \
         the file is damaged, or measured from below, which is not read"
    )]
    Direction {
        /// The file.
        file: String,
        /// Where it is.
        offset: u64,
        /// View or light.
        what: &'static str,
        /// Its index.
        index: u64,
        /// As stored.
        theta: f32,
        /// As stored.
        phi: f32,
    },
    /// Views with lights of their own.
    #[error(
        "{file}: at byte {offset}, the lights of view {view} differ from those of view 0; only one list of lights for all views is read"
    )]
    Lights {
        /// The file.
        file: String,
        /// Where the view's list is.
        offset: u64,
        /// The view.
        view: u64,
    },
}
