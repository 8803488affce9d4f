//! Where a certificate is written.

use std::ffi::OsStr;
use std::path::Path;

use clap::ValueEnum;
use knotproof::certificate::Encoding;
use tempfile::NamedTempFile;

use super::atomic_file::AtomicFile;
use super::report::Written;
use crate::cli::failure::Failure;
use crate::cli::input::Input;

/// The form of a certificate.
#[derive(Clone, Copy, ValueEnum)]
pub enum Format {
    /// Readable, for small certificates
    Json,
    /// Compact, for large ones
    Binary,
}

/// The form asked for, or that of the file's name.
pub fn encoding(format: Option<Format>, path: &Path) -> Encoding {
    match format {
        Some(Format::Json) => Encoding::Json,
        Some(Format::Binary) => Encoding::Binary,
        None if path.extension() == Some(OsStr::new("bin")) => Encoding::Binary,
        None => Encoding::Json,
    }
}

/// A file for a certificate.
pub struct Target(AtomicFile);

impl Target {
    /// The place of the certificate, looked at before the search so that hours are not spent for nothing.
    pub fn new(path: Option<&Path>, curve: &Input) -> Result<Option<Target>, Failure> {
        let Some(path) = path else {
            return Ok(None);
        };
        if path == Path::new("-") {
            return Err(Failure::new(
                "-o: the certificate cannot be written to standard output, which shows the result; name a file",
            ));
        }
        let target = AtomicFile::new(path)?;
        match curve {
            Input::File(curve) if target.replaces(curve) => Err(Failure::at(
                path.display(),
                "the certificate would replace the curve file",
            )),
            _ => Ok(Some(Target(target))),
        }
    }

    /// The path as it was given.
    pub fn path(&self) -> &Path {
        self.0.path()
    }

    /// The failure of writing.
    pub fn failure(&self, error: &std::io::Error) -> Failure {
        self.0.failure(error)
    }

    /// Writes by `write`, which lets the checker read it back, and only then gives the file its name.
    pub fn write(&self, write: impl FnOnce(&mut NamedTempFile) -> Result<(), Failure>) -> Result<Written, Failure> {
        let mut file = self.0.begin()?;
        write(&mut file)?;
        let bytes = self.0.finish(file)?;
        Ok(Written {
            path: self.path().to_path_buf(),
            bytes,
        })
    }
}
