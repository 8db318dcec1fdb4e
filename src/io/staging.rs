//! Results that appear whole or not at all.

use std::path::{Path, PathBuf};

use tempfile::TempDir;

use super::IoError;

/// A hidden folder beside a target. The result is made in it and then renamed to the target's name, which happens
/// within one file system and therefore at once; whatever is left in the folder is removed with it. A killed process
/// leaves the hidden folder behind and the target as it was, except between the two renames that replace a folder: then
/// the target is absent, and the hidden folder beside it holds the old one and the new one.
pub(super) struct Staging {
    folder: TempDir,
    target: PathBuf,
}

impl Staging {
    /// Prepares to write `target`, whose folder must exist.
    pub(super) fn beside(target: &Path) -> Result<Self, IoError> {
        let parent = target.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let folder = tempfile::Builder::new().prefix(".overpaint-").tempdir_in(parent);
        let folder = folder.map_err(|source| IoError::Write { path: target.to_owned(), source })?;
        Ok(Self { folder, target: target.to_owned() })
    }

    /// Where to make the result.
    pub(super) fn path(&self) -> PathBuf {
        self.folder.path().join("new")
    }

    /// Renames the result to the target's name. A file replaces a file at once. Before a folder replaces a folder, the old
    /// one is moved into the staging folder, and back again if the new one cannot take its place. A file never replaces a
    /// folder.
    pub(super) fn commit(mut self) -> Result<(), IoError> {
        let old = self.folder.path().join("old");
        let replaced = if self.target.is_dir() && self.path().is_dir() { std::fs::rename(&self.target, &old) } else { Ok(()) };
        let result = replaced.and_then(|()| std::fs::rename(self.path(), &self.target));
        if result.is_err() && old.exists() && std::fs::rename(&old, &self.target).is_err() {
            // The old folder must not be removed with the staging folder.
            self.folder.disable_cleanup(true);
        }
        result.map_err(|source| IoError::Write { path: self.target.clone(), source })
    }
}

/// Writes a file that appears under its name whole or not at all. What is there and no plain file, as a link or a device, is
/// written to and not replaced.
///
/// # Errors
/// [`IoError::Write`].
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), IoError> {
    let failed = |source| IoError::Write { path: path.to_owned(), source };
    if path.symlink_metadata().is_ok_and(|there| !there.is_file()) {
        return std::fs::write(path, bytes).map_err(failed);
    }
    let staging = Staging::beside(path)?;
    std::fs::write(staging.path(), bytes).map_err(failed)?;
    staging.commit()
}
