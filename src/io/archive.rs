//! Folders and .zip archives as lists of files that are read by index, from any number of threads at once.

use std::{
    fs::File,
    io::{Cursor, Read, Seek},
    path::{Path, PathBuf},
    sync::Arc,
    time::UNIX_EPOCH,
};

use zip::{
    ZipArchive,
    read::{ZipArchiveMetadata, ZipReadOptions},
    result::ZipError,
};

use super::IoError;

/// The largest file that is taken for one image: room for 8192 x 8192 RGBA texels without compression.
const MAX_BYTES: u64 = 1 << 28;

/// The files of a folder and its folders, or of a .zip archive.
#[derive(Debug)]
pub(super) struct Archive {
    path: PathBuf,
    /// Names relative to `path`, with `/`.
    names: Vec<String>,
    store: Store,
}

#[derive(Debug)]
enum Store {
    Folder,
    /// Each read opens the archive anew, so that threads do not share a position.
    Zip(Arc<ZipArchiveMetadata>),
    /// A .zip archive in memory.
    ZipBytes(&'static [u8], Arc<ZipArchiveMetadata>),
}

impl Archive {
    /// Lists a folder or a .zip archive.
    pub(super) fn open(path: &Path) -> Result<Self, IoError> {
        if !path.exists() {
            return Err(IoError::NotFound { path: path.to_owned() });
        }
        if path.is_dir() {
            let mut names = Vec::new();
            list(path, "", &mut names)?;
            // The order in which a system lists a folder means nothing.
            names.sort_unstable();
            return Ok(Self { path: path.to_owned(), names, store: Store::Folder });
        }
        let unreadable = |source| IoError::Read { file: path.display().to_string(), source };
        let mut file = File::open(path).map_err(unreadable)?;
        let mut start = Vec::new();
        file.by_ref().take(16).read_to_end(&mut start).map_err(unreadable)?;
        if !start.starts_with(b"PK") {
            return Err(IoError::NotAnArchive { path: path.to_owned(), found: first_bytes(&start) });
        }
        let (names, metadata) = directory(path, file)?;
        Ok(Self { path: path.to_owned(), names, store: Store::Zip(metadata) })
    }

    /// Lists a .zip archive in memory under the given name.
    pub(super) fn from_bytes(name: &str, bytes: &'static [u8]) -> Result<Self, IoError> {
        let path = PathBuf::from(name);
        let (names, metadata) = directory(&path, Cursor::new(bytes))?;
        Ok(Self { path, names, store: Store::ZipBytes(bytes, metadata) })
    }

    /// A text that is another when a name, a size or a time of modification of the given files is another. Other files do not count: a result may
    /// be written beside its source.
    pub(super) fn fingerprint(&self, files: &[usize]) -> String {
        let mut hash = crc32fast::Hasher::new();
        let mut add = |path: &Path| {
            if let Ok(metadata) = path.metadata() {
                let modified = metadata.modified().ok().and_then(|time| time.duration_since(UNIX_EPOCH).ok()).unwrap_or_default();
                hash.update(&metadata.len().to_le_bytes());
                hash.update(&modified.as_nanos().to_le_bytes());
            }
        };
        match &self.store {
            Store::Folder => files.iter().for_each(|&file| add(&self.path.join(&self.names[file]))),
            Store::Zip(_) => add(&self.path),
            Store::ZipBytes(bytes, _) => hash.update(bytes),
        }
        files.iter().for_each(|&file| hash.update(self.names[file].as_bytes()));
        format!("{} files, {:08x}", files.len(), hash.finalize())
    }

    /// Where it is.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Name of the folder, or of the archive without its extension.
    pub(super) fn stem(&self) -> String {
        // "." and ".." have a name only once resolved.
        let path = self.path.canonicalize().unwrap_or_else(|_| self.path.clone());
        let name = if matches!(self.store, Store::Zip(_)) { path.file_stem() } else { path.file_name() };
        name.map_or_else(|| path.display().to_string(), |name| name.to_string_lossy().into_owned())
    }

    /// Names of all files, relative to the folder or archive, with `/`.
    pub(super) fn names(&self) -> &[String] {
        &self.names
    }

    /// The name of file `index` for people: the path, or the archive's path and the name inside it.
    pub(super) fn label(&self, index: usize) -> String {
        match self.store {
            Store::Folder => self.path.join(&self.names[index]).display().to_string(),
            Store::Zip(_) | Store::ZipBytes(..) => format!("{}: {}", self.path.display(), self.names[index]),
        }
    }

    /// The bytes of file `index`.
    pub(super) fn read(&self, index: usize) -> Result<Vec<u8>, IoError> {
        let unreadable = |source| IoError::Read { file: self.label(index), source };
        match &self.store {
            Store::Folder => {
                let file = File::open(self.path.join(&self.names[index])).map_err(unreadable)?;
                let declared = file.metadata().map_err(unreadable)?.len();
                bounded(&self.label(index), declared, file).map_err(unreadable)?
            }
            Store::Zip(metadata) => {
                let file = File::open(&self.path).map_err(|source| IoError::Read { file: self.path.display().to_string(), source })?;
                self.entry(index, metadata, file)
            }
            Store::ZipBytes(bytes, metadata) => self.entry(index, metadata, Cursor::new(bytes)),
        }
    }

    fn entry<R: Read + Seek>(&self, index: usize, metadata: &ZipArchiveMetadata, mut reader: R) -> Result<Vec<u8>, IoError> {
        let damaged = |message: String| IoError::Archive { file: self.label(index), message };
        let entry = metadata.entry(index).map_err(|error| damaged(error.to_string()))?;
        let declared = entry.size();
        let file = entry.with_reader(&mut reader, ZipReadOptions::new()).map_err(|error| damaged(error.to_string()))?;
        let bytes = bounded(&self.label(index), declared, file).map_err(|error| damaged(error.to_string()))??;
        if bytes.len() as u64 == declared {
            Ok(bytes)
        } else {
            Err(damaged(format!("{declared} bytes are declared, {} are there", bytes.len())))
        }
    }
}

/// Reads the file called `label` to its end, but never more than [`MAX_BYTES`], whatever is declared.
pub(super) fn bounded(label: &str, declared: u64, reader: impl Read) -> std::io::Result<Result<Vec<u8>, IoError>> {
    let too_many = |found| Ok(Err(IoError::TooManyBytes { file: label.to_owned(), found, limit: MAX_BYTES }));
    if declared > MAX_BYTES {
        return too_many(declared);
    }
    let mut bytes = Vec::new();
    reader.take(MAX_BYTES + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MAX_BYTES { too_many(bytes.len() as u64) } else { Ok(Ok(bytes)) }
}

/// The central directory of a .zip archive: names and places of its entries.
fn directory<R: Read + Seek>(path: &Path, reader: R) -> Result<(Vec<String>, Arc<ZipArchiveMetadata>), IoError> {
    let damaged = |message: String| IoError::Archive { file: path.display().to_string(), message };
    let archive = ZipArchive::new(reader).map_err(|error: ZipError| damaged(error.to_string()))?;
    if archive.has_duplicate_names() {
        return Err(damaged("it holds two files of the same name".to_owned()));
    }
    let names = archive.file_names_raw().map(|name| String::from_utf8_lossy(name).into_owned()).collect();
    Ok((names, archive.metadata()))
}

/// Adds the files of `folder` and of the folders in it. Linked files are followed, linked folders are not: they may lead
/// in a circle.
fn list(folder: &Path, prefix: &str, names: &mut Vec<String>) -> Result<(), IoError> {
    let unreadable = |source| IoError::Read { file: folder.display().to_string(), source };
    for entry in std::fs::read_dir(folder).map_err(unreadable)? {
        let entry = entry.map_err(unreadable)?;
        let name = format!("{prefix}{}", entry.file_name().to_string_lossy());
        if entry.file_type().map_err(unreadable)?.is_dir() {
            list(&entry.path(), &format!("{name}/"), names)?;
        } else {
            names.push(name);
        }
    }
    Ok(())
}

/// The start of a file, printable.
pub(super) fn first_bytes(bytes: &[u8]) -> String {
    if bytes.is_empty() { "nothing (it is empty)".to_owned() } else { format!("\"{}\"", bytes[..bytes.len().min(8)].escape_ascii()) }
}
