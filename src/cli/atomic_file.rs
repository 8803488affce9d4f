//! Files that are there whole or not at all.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use tempfile::{Builder, NamedTempFile};

use super::failure::Failure;

/// Begins the names of files that are not whole yet.
const PREFIX: &str = ".knotproof-";
/// Ends them.
const SUFFIX: &str = ".partial";

/// A file to be written beside its place and moved there when whole; whatever stands there stays until then.
pub struct AtomicFile {
    shown: PathBuf,
    target: PathBuf,
}

impl AtomicFile {
    /// A file to be written at `path`. Looks whether that can be done, and writes nothing.
    pub fn new(path: &Path) -> Result<AtomicFile, Failure> {
        let failure = |error: &io::Error| Failure::io(path.display(), "cannot be written", error);
        let target = match fs::metadata(path) {
            // What a link points to is replaced, not the link.
            Ok(found) if found.is_file() => fs::canonicalize(path).map_err(|error| failure(&error))?,
            Ok(_) => {
                return Err(Failure::at(path.display(), "cannot be written: not a regular file"));
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound && path.file_name().is_some() => path.to_path_buf(),
            Err(error) => return Err(failure(&error)),
        };
        let file = AtomicFile {
            shown: path.to_path_buf(),
            target,
        };
        file.begin()?;
        Ok(file)
    }

    /// Would this file replace the one at `path`?
    pub fn replaces(&self, path: &Path) -> bool {
        fs::canonicalize(path).is_ok_and(|path| fs::canonicalize(&self.target).is_ok_and(|target| target == path))
    }

    /// The path as it was given.
    #[cfg(feature = "prove")]
    pub fn path(&self) -> &Path {
        &self.shown
    }

    /// An empty file in the same directory, under a name that nobody takes for a finished file's; gone when dropped.
    pub fn begin(&self) -> Result<NamedTempFile, Failure> {
        let directory = match self.target.parent() {
            Some(parent) if parent != Path::new("") => parent,
            _ => Path::new("."),
        };
        if !directory.is_dir() {
            let what = format!("cannot be written: there is no directory {}", directory.display());
            return Err(Failure::at(self.shown.display(), what));
        }
        let mut builder = Builder::new();
        builder.prefix(PREFIX).suffix(SUFFIX);
        // Readable by whom new files are readable, not by the owner alone.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        // The error's own text names a file that the user never asked for.
        builder
            .tempfile_in(directory)
            .map_err(|error| self.failure(&error.kind().into()))
    }

    /// Moves a finished file to its place; returns its size in bytes.
    pub fn finish(&self, file: NamedTempFile) -> Result<u64, Failure> {
        let size = || -> io::Result<u64> {
            file.as_file().sync_all()?;
            Ok(file.as_file().metadata()?.len())
        };
        let size = size().map_err(|error| self.failure(&error))?;
        file.persist(&self.target).map_err(|error| self.failure(&error.error))?;
        Ok(size)
    }

    /// The failure of writing.
    pub fn failure(&self, error: &io::Error) -> Failure {
        Failure::io(self.shown.display(), "cannot be written", error)
    }
}
