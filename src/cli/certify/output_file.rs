//! Where a certificate is written.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use knotproof::certificate::{Document, Encoding};
use knotproof::claim::AsClaim;
use knotproof::curve::CurveFile;
use knotproof::prove::domain::{CertifyError, write_checked};
use tempfile::{NamedTempFile, SpooledTempFile};

use super::report::Written;
use crate::cli::Printing;
use crate::cli::atomic_file::AtomicFile;
use crate::cli::batch::options::{MANY, Many};
use crate::cli::failure::Failure;
use crate::cli::input::Input;
#[cfg(feature = "import")]
use crate::cli::output::remark;
#[cfg(feature = "import")]
use crate::cli::reading::Reading;

/// The form of a certificate.
#[derive(Clone, Copy, ValueEnum)]
pub enum Format {
    /// Readable, for small certificates
    Json,
    /// Compact, for large ones
    Binary,
}

/// What every claim's command takes beside its own options.
#[derive(Args)]
pub struct Common {
    /// Write the certificate to this file. It is there only when whole, and accepted by the checker. Of a batch, the folder for the certificates.
    #[arg(long, short, value_name = "CERT")]
    pub output: Option<PathBuf>,
    /// The form of the certificate [default: binary when the name of CERT ends in ".bin", else json]
    #[arg(long, value_enum, requires = "output")]
    pub format: Option<Format>,
    /// Where a Bézier piece does not start exactly where the one before ends, move its start there.
    #[arg(long)]
    pub snap_joints: bool,
    #[cfg(feature = "import")]
    #[command(flatten)]
    pub reading: Reading,
    /// Take every curve of the file, as a batch.
    #[arg(long, help_heading = MANY)]
    pub all: bool,
    /// What makes it a batch.
    #[command(flatten)]
    pub many: Many,
    /// What is printed.
    #[command(flatten)]
    pub printing: Printing,
}

impl Common {
    /// Is a batch asked for? It is where there are several files, a folder among them, or an option that makes sense for many curves alone.
    pub fn makes_a_batch(&self, inputs: &[Input]) -> bool {
        let folder = |path: &Path| path.is_dir() || path.to_string_lossy().ends_with(std::path::is_separator);
        inputs.len() > 1
            || self.all
            || self.many.is_given()
            || self.output.as_deref().is_some_and(folder)
            || inputs
                .iter()
                .any(|input| matches!(input, Input::File(path) if path.is_dir()))
    }

    /// The place of the certificate.
    pub fn target(&self, curve: &Input) -> Result<Option<Target>, Failure> {
        Target::new(self.output.as_deref(), curve)
    }

    /// Reads the curve, of whatever format, and tells on standard error what reading changed.
    pub fn read(&self, curve: &Input) -> Result<CurveFile, Failure> {
        #[cfg(not(feature = "import"))]
        {
            curve.read_curve(self.snap_joints)
        }
        #[cfg(feature = "import")]
        {
            let (file, notes) = curve.read_curve_with(self.snap_joints, &self.reading)?;
            if !self.printing.quiet {
                notes.iter().for_each(|note| remark(&format!("{curve}: {note}")));
            }
            Ok(file)
        }
    }
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

/// Writes the certificate, or lets the checker replay it all the same when no file is asked for.
pub fn write<C: AsClaim>(
    document: &Document<C>,
    target: Option<&Target>,
    format: Option<Format>,
) -> Result<Option<Written>, Failure> {
    match target {
        Some(target) => {
            let encoding = encoding(format, target.path());
            let write = |file: &mut _| write_checked(document, encoding, file).map_err(|error| failure(&error));
            target.write(write).map(Some)
        }
        None => {
            let mut nowhere = SpooledTempFile::new(1 << 26);
            write_checked(document, Encoding::Binary, &mut nowhere).map_err(|error| failure(&error))?;
            Ok(None)
        }
    }
}

fn failure(error: &CertifyError) -> Failure {
    match error {
        CertifyError::Io(error) => Failure::io("the certificate", "cannot be written", error),
        CertifyError::Refuted(_) => Failure::new(format!("{error}; this is an error of knotproof, please report it")),
    }
}
