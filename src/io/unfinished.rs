//! Work that survives being killed: the hidden folder beside a target in which a long job keeps what it has finished.
//!
//! The folder is named after the target and says, in `job.json`, what the job is. The same job run again finds it and goes on; another job
//! is refused, since its predecessor's work would be lost. A record appears whole or not at all, and its checksum tells a damaged one,
//! which counts as not there. A lock keeps two runs apart; the system lets go of it however a process ends.

use std::{
    fs::{self, File, TryLockError},
    io::ErrorKind,
    path::{Path, PathBuf},
};

use serde_json::Value;

use super::IoError;

/// The unfinished job of one target.
#[derive(Debug)]
pub struct Unfinished {
    folder: PathBuf,
    target: PathBuf,
    is_resumed: bool,
    /// Held as long as the job runs.
    _lock: File,
}

const JOB: &str = "job.json";
const LOCK: &str = "lock";
const COMPLETE: &str = "complete";
const RESULT: &str = "result";
const REPLACED: &str = "replaced";

impl Unfinished {
    /// Begins the job of making `target`, or goes on with it. `job` is an object that holds all that its result depends on.
    ///
    /// # Errors
    /// [`IoError::OtherJob`] if an unfinished job with another description has finished parts there, [`IoError::Running`] if it is being worked on, and
    /// [`IoError`] if the system refuses to read or write.
    pub fn begin(target: &Path, job: &Value) -> Result<Self, IoError> {
        let name = target.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        let folder = target.with_file_name(format!(".{name}.unfinished"));
        let failed = |source| IoError::Write { path: folder.clone(), source };
        fs::create_dir_all(&folder).map_err(failed)?;
        let lock = File::create(folder.join(LOCK)).map_err(failed)?;
        match lock.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Err(IoError::Running { target: target.to_owned() }),
            Err(TryLockError::Error(source)) => return Err(failed(source)),
        }
        let mut unfinished = Self { folder, target: target.to_owned(), is_resumed: false, _lock: lock };
        match fs::read(unfinished.folder.join(JOB)) {
            Ok(text) => {
                unfinished.compare(job, &text)?;
                unfinished.is_resumed = true;
            }
            Err(error) if error.kind() == ErrorKind::NotFound => unfinished.start(job)?,
            Err(source) => return Err(IoError::Read { file: unfinished.folder.join(JOB).display().to_string(), source }),
        }
        // Completed and then taken away: the job is to be done anew.
        if unfinished.is_complete() && !unfinished.result().exists() && !target.exists() {
            unfinished.start(job)?;
            unfinished.is_resumed = false;
        }
        Ok(unfinished)
    }

    fn start(&self, job: &Value) -> Result<(), IoError> {
        self.clear(&[LOCK])?;
        self.write(JOB, job.to_string().as_bytes())
    }

    fn compare(&self, job: &Value, text: &[u8]) -> Result<(), IoError> {
        let found: Value = serde_json::from_slice(text).unwrap_or(Value::Null);
        if found == *job {
            return Ok(());
        }
        // A job that ended before it had finished anything is nobody's loss.
        if self.names()?.is_empty() && !self.result().exists() {
            return self.start(job);
        }
        let keys = job.as_object().into_iter().flat_map(|object| object.keys());
        let differing: Vec<&str> = keys.filter(|key| job[key.as_str()] != found[key.as_str()]).map(String::as_str).collect();
        Err(IoError::OtherJob { target: self.target.clone(), folder: self.folder.clone(), differing: differing.join(", ") })
    }

    /// Keeps `bytes` under `name`, a plain file name.
    ///
    /// # Errors
    /// [`IoError::Write`].
    pub fn put(&self, name: &str, bytes: &[u8]) -> Result<(), IoError> {
        self.write(name, &[&crc32fast::hash(bytes).to_le_bytes(), bytes].concat())
    }

    /// What was kept under `name`, if it is there and undamaged.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<Vec<u8>> {
        let mut bytes = fs::read(self.folder.join(name)).ok()?;
        let (checksum, rest) = bytes.split_first_chunk::<4>()?;
        if crc32fast::hash(rest) != u32::from_le_bytes(*checksum) {
            return None;
        }
        bytes.drain(..4);
        Some(bytes)
    }

    /// Names of all that [`Self::put`] has kept, sorted.
    ///
    /// # Errors
    /// [`IoError::Read`].
    pub fn names(&self) -> Result<Vec<String>, IoError> {
        let failed = |source| IoError::Read { file: self.folder.display().to_string(), source };
        let mut names = Vec::new();
        for entry in fs::read_dir(&self.folder).map_err(failed)? {
            let entry = entry.map_err(failed)?;
            let name = entry.file_name().to_string_lossy().into_owned();
            if entry.path().is_file() && ![JOB, LOCK, COMPLETE].contains(&name.as_str()) && !name.ends_with(".new") {
                names.push(name);
            }
        }
        names.sort_unstable();
        Ok(names)
    }

    /// Whether an earlier run has begun the job.
    #[must_use]
    pub fn is_resumed(&self) -> bool {
        self.is_resumed
    }

    /// Where a result that is a folder of its own is made.
    #[must_use]
    pub fn result(&self) -> PathBuf {
        self.folder.join(RESULT)
    }

    /// Whether the result was complete when the job was killed.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.folder.join(COMPLETE).exists()
    }

    /// Ends the job: puts [`Self::result`], if one was made, in the target's place and removes everything else. Killed in between, the next
    /// run finds the job complete and ends it by calling this again.
    ///
    /// # Errors
    /// [`IoError::Write`].
    pub fn commit(self) -> Result<(), IoError> {
        let failed = |source| IoError::Write { path: self.target.clone(), source };
        self.write(COMPLETE, b"")?;
        if self.result().exists() {
            if self.target.exists() {
                let replaced = self.folder.join(REPLACED);
                if replaced.exists() {
                    fs::remove_dir_all(&replaced).map_err(failed)?;
                }
                fs::rename(&self.target, &replaced).map_err(failed)?;
            }
            fs::rename(self.result(), &self.target).map_err(failed)?;
        }
        // What tells that the job is complete goes last.
        self.clear(&[LOCK, COMPLETE, JOB])?;
        fs::remove_dir_all(&self.folder).map_err(failed)
    }

    /// Removes everything but what is named.
    fn clear(&self, but: &[&str]) -> Result<(), IoError> {
        let remove = || {
            for entry in fs::read_dir(&self.folder)? {
                let entry = entry?;
                if !but.iter().any(|name| entry.file_name() == **name) {
                    if entry.file_type()?.is_dir() { fs::remove_dir_all(entry.path()) } else { fs::remove_file(entry.path()) }?;
                }
            }
            Ok(())
        };
        remove().map_err(|source| IoError::Write { path: self.folder.clone(), source })
    }

    /// A file that is there whole or not at all.
    fn write(&self, name: &str, bytes: &[u8]) -> Result<(), IoError> {
        let (new, path) = (self.folder.join(format!("{name}.new")), self.folder.join(name));
        fs::write(&new, bytes).and_then(|()| fs::rename(&new, &path)).map_err(|source| IoError::Write { path, source })
    }
}
