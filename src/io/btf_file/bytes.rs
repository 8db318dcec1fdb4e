//! Positional reads, and a header's fields with their checks.

use std::{
    fmt::Debug,
    fs::File,
    io::{self, Error},
    path::Path,
    sync::Arc,
    time::UNIX_EPOCH,
};

use super::{BtfFileError, scalar::Scalar};
use crate::io::IoError;

/// Bytes that are read at any position, by any number of threads at once.
trait ReadAt: Send + Sync + Debug {
    /// Fills `into` from byte `offset` on.
    fn read_exact_at(&self, into: &mut [u8], offset: u64) -> io::Result<()>;
}

impl ReadAt for File {
    #[cfg(unix)]
    fn read_exact_at(&self, into: &mut [u8], offset: u64) -> io::Result<()> {
        std::os::unix::fs::FileExt::read_exact_at(self, into, offset)
    }

    #[cfg(windows)]
    fn read_exact_at(&self, mut into: &mut [u8], mut offset: u64) -> io::Result<()> {
        while !into.is_empty() {
            match std::os::windows::fs::FileExt::seek_read(self, into, offset) {
                Ok(0) => return Err(io::ErrorKind::UnexpectedEof.into()),
                Ok(read) => (into, offset) = (&mut into[read..], offset + read as u64),
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
        Ok(())
    }
}

impl ReadAt for Arc<[u8]> {
    fn read_exact_at(&self, into: &mut [u8], offset: u64) -> io::Result<()> {
        let there = usize::try_from(offset).ok().and_then(|start| self.get(start..start.checked_add(into.len())?));
        into.copy_from_slice(there.ok_or(Error::from(io::ErrorKind::UnexpectedEof))?);
        Ok(())
    }
}

/// A container's name and bytes.
#[derive(Debug)]
pub(super) struct Container {
    file: String,
    length: u64,
    bytes: Box<dyn ReadAt>,
    fingerprint: String,
}

impl Container {
    /// A file.
    pub(super) fn open(path: &Path) -> Result<Self, IoError> {
        let unreadable = |source| IoError::Read { file: path.display().to_string(), source };
        let file = File::open(path).map_err(unreadable)?;
        let metadata = file.metadata().map_err(unreadable)?;
        let modified = metadata.modified().ok().and_then(|time| time.duration_since(UNIX_EPOCH).ok()).unwrap_or_default();
        let mut hash = crc32fast::Hasher::new();
        hash.update(path.file_name().unwrap_or_default().as_encoded_bytes());
        hash.update(&modified.as_nanos().to_le_bytes());
        let fingerprint = format!("{} bytes, {:08x}", metadata.len(), hash.finalize());
        Ok(Self { file: path.display().to_string(), length: metadata.len(), bytes: Box::new(file), fingerprint })
    }

    /// A file that is in memory.
    pub(super) fn from_bytes(name: &str, bytes: Arc<[u8]>) -> Self {
        let fingerprint = format!("{} bytes, {:08x}", bytes.len(), crc32fast::hash(&bytes));
        Self { file: name.to_owned(), length: bytes.len() as u64, bytes: Box::new(bytes), fingerprint }
    }

    pub(super) fn file(&self) -> &str {
        &self.file
    }

    pub(super) fn fingerprint(&self) -> &str {
        &self.fingerprint
    }

    /// As many bytes from the start as there are, but at most `most`.
    pub(super) fn start(&self, most: u8) -> Result<Vec<u8>, BtfFileError> {
        let mut start = vec![0; usize::from(most).min(usize::try_from(self.length).unwrap_or(usize::MAX))];
        self.read(&mut start, 0)?;
        Ok(start)
    }

    /// Fills `into` from byte `offset` on.
    pub(super) fn read(&self, into: &mut [u8], offset: u64) -> Result<(), BtfFileError> {
        let bytes = into.len();
        self.bytes.read_exact_at(into, offset).map_err(|source| BtfFileError::Read { file: self.file.clone(), offset, bytes, source })
    }
}

/// Reads a header from its start to its end. Nothing is allocated for what the file is too short for.
#[derive(Debug, Clone)]
pub(super) struct Header<'a> {
    container: &'a Container,
    offset: u64,
}

impl<'a> Header<'a> {
    /// The header after a signature of `signature` bytes.
    pub(super) fn new(container: &'a Container, signature: usize) -> Self {
        Self { container, offset: signature as u64 }
    }

    pub(super) fn container(&self) -> &'a Container {
        self.container
    }

    /// Where the next field is.
    pub(super) fn offset(&self) -> u64 {
        self.offset
    }

    /// Passes `factors` multiplied as many bytes and gives their first position.
    pub(super) fn pass(&mut self, what: &'static str, factors: &[u64]) -> Result<u64, BtfFileError> {
        let offset = self.offset;
        let Some(bytes) = factors.iter().try_fold(1_u64, |product, &factor| product.checked_mul(factor)) else {
            return Err(self.too_large(offset, what, factors));
        };
        let left = self.container.length.saturating_sub(offset);
        if bytes > left {
            let file = self.container.file.clone();
            return Err(BtfFileError::TooShort { file, offset, what, expected: bytes, found: left });
        }
        self.offset += bytes;
        Ok(offset)
    }

    /// The next `count` bytes.
    pub(super) fn bytes(&mut self, what: &'static str, count: u64) -> Result<Vec<u8>, BtfFileError> {
        let offset = self.pass(what, &[count])?;
        let mut bytes = vec![0; self.count(offset, what, &[count])?];
        self.container.read(&mut bytes, offset)?;
        Ok(bytes)
    }

    fn array<const N: usize>(&mut self, what: &'static str) -> Result<[u8; N], BtfFileError> {
        let offset = self.pass(what, &[N as u64])?;
        let mut bytes = [0; N];
        self.container.read(&mut bytes, offset)?;
        Ok(bytes)
    }

    pub(super) fn u8(&mut self, what: &'static str) -> Result<u8, BtfFileError> {
        Ok(self.array::<1>(what)?[0])
    }

    pub(super) fn u32(&mut self, what: &'static str) -> Result<u32, BtfFileError> {
        Ok(u32::from_le_bytes(self.array(what)?))
    }

    pub(super) fn i32(&mut self, what: &'static str) -> Result<i32, BtfFileError> {
        Ok(i32::from_le_bytes(self.array(what)?))
    }

    pub(super) fn f32(&mut self, what: &'static str) -> Result<f32, BtfFileError> {
        Ok(f32::from_le_bytes(self.array(what)?))
    }

    /// The size of a scalar.
    pub(super) fn scalar(&mut self) -> Result<Scalar, BtfFileError> {
        let offset = self.offset;
        let bytes = self.u8("size of a scalar")?;
        Scalar::of_bytes(bytes).ok_or_else(|| self.unexpected(offset, "size of a scalar", "2, 4 or 8 bytes", bytes))
    }

    /// A count that is not 0.
    pub(super) fn positive(&mut self, what: &'static str) -> Result<u32, BtfFileError> {
        let offset = self.offset;
        match self.u32(what)? {
            0 => Err(self.unexpected(offset, what, "of 1 or more", 0)),
            count => Ok(count),
        }
    }

    /// `factors` multiplied, as a length in memory.
    pub(super) fn count(&self, offset: u64, what: &'static str, factors: &[u64]) -> Result<usize, BtfFileError> {
        let product = factors.iter().try_fold(1_u64, |product, &factor| product.checked_mul(factor));
        let fits = product.and_then(|product| usize::try_from(product).ok()).filter(|&count| isize::try_from(count).is_ok());
        fits.ok_or_else(|| self.too_large(offset, what, factors))
    }

    /// The error of a field at byte `offset`.
    pub(super) fn unexpected(&self, offset: u64, what: &'static str, expected: impl ToString, found: impl ToString) -> BtfFileError {
        let file = self.container.file.clone();
        BtfFileError::Unexpected { file, offset, what, expected: expected.to_string(), found: found.to_string() }
    }

    /// The error of contents that are not read.
    pub(super) fn unsupported(&self, offset: u64, what: &'static str, expected: &'static str, found: impl ToString) -> BtfFileError {
        BtfFileError::Unsupported { file: self.container.file.clone(), offset, what, expected, found: found.to_string() }
    }

    fn too_large(&self, offset: u64, what: &'static str, factors: &[u64]) -> BtfFileError {
        let found = factors.iter().map(u64::to_string).collect::<Vec<_>>().join(" x ");
        BtfFileError::TooLarge { file: self.container.file.clone(), offset, what, found }
    }
}
