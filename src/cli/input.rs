//! Reading files and standard input.

use std::ffi::OsString;
use std::fmt;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use knotproof::curve::{CurveFault, CurveFile, ReadFault, ReadOptions, read_curve_with};
#[cfg(feature = "import")]
use knotproof::import::{Format, detect};

use super::failure::Failure;
#[cfg(feature = "import")]
use super::reading::Reading;

/// A file to read, or standard input, written `-`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Input {
    /// Standard input.
    Standard,
    /// A file.
    File(PathBuf),
}

impl From<OsString> for Input {
    fn from(text: OsString) -> Input {
        if text == "-" {
            Input::Standard
        } else {
            Input::File(text.into())
        }
    }
}

impl fmt::Display for Input {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Input::Standard => f.write_str("standard input"),
            Input::File(path) => path.display().fmt(f),
        }
    }
}

impl Input {
    /// Opens it.
    pub fn open(&self) -> Result<Box<dyn Read>, Failure> {
        match self {
            Input::Standard => Ok(Box::new(io::stdin())),
            Input::File(path) => match File::open(path) {
                Ok(file) => Ok(Box::new(file)),
                Err(error) => Err(self.unreadable(&error)),
            },
        }
    }

    /// The failure of reading it.
    pub fn unreadable(&self, error: &io::Error) -> Failure {
        Failure::io(self, "cannot be read", error)
    }

    /// Is it a regular file that holds a curve?
    pub fn is_curve_file(&self) -> bool {
        match self {
            Input::File(path) if path.is_file() => self.read_curve(true).is_ok(),
            _ => false,
        }
    }

    /// All of it.
    pub fn bytes(&self) -> Result<Vec<u8>, Failure> {
        let mut bytes = Vec::new();
        self.open()?
            .read_to_end(&mut bytes)
            .map_err(|error| self.unreadable(&error))?;
        Ok(bytes)
    }

    /// The files in a folder, in the order of their names; not hidden ones, and not those of folders in it.
    pub fn files_in(&self, folder: &Path) -> Result<Vec<PathBuf>, Failure> {
        let mut found = Vec::new();
        for entry in fs::read_dir(folder).map_err(|error| self.unreadable(&error))? {
            let entry = entry.map_err(|error| self.unreadable(&error))?;
            let hidden = entry.file_name().to_string_lossy().starts_with('.');
            if !hidden && entry.path().is_file() {
                found.push(entry.path());
            }
        }
        found.sort();
        Ok(found)
    }

    /// Reads it as a curve file, or as a file of another format that holds one curve.
    pub fn read_curve(&self, snap_joints: bool) -> Result<CurveFile, Failure> {
        #[cfg(feature = "import")]
        {
            Ok(self.read_curve_with(snap_joints, &Reading::default())?.0)
        }
        #[cfg(not(feature = "import"))]
        {
            self.curve_file(&self.bytes()?, snap_joints)
        }
    }

    /// Reads it as a curve file or as one of another format, with what there is to know of the curve.
    #[cfg(feature = "import")]
    pub fn read_curve_with(&self, snap_joints: bool, reading: &Reading) -> Result<(CurveFile, Vec<String>), Failure> {
        let bytes = self.bytes()?;
        match detect(&bytes) {
            // Bytes that show nothing are told by the reader of curve files.
            None | Some(Format::Curve) => Ok((self.curve_file(&bytes, snap_joints)?, Vec::new())),
            Some(_) => reading.one_curve(self, &bytes),
        }
    }

    /// Reads its bytes as a curve file.
    pub fn curve_file(&self, bytes: &[u8], snap_joints: bool) -> Result<CurveFile, Failure> {
        read_curve_with(bytes, ReadOptions { snap_joints }).map_err(|error| {
            let hint = match &error.fault {
                ReadFault::Curve(CurveFault::Gap) => {
                    "; --snap-joints moves the starts of pieces to the ends before them"
                }
                _ => "",
            };
            Failure::at(self, format!("{error}{hint}"))
        })
    }
}

/// Refuses a command line that reads standard input more than once.
pub fn standard_input_once<'i>(inputs: impl IntoIterator<Item = &'i Input>) -> Result<(), Failure> {
    match inputs.into_iter().filter(|input| **input == Input::Standard).count() {
        0 | 1 => Ok(()),
        _ => Err(Failure::new("standard input, \"-\", can be read only once")),
    }
}

/// A reader that keeps the error it met, for readers behind it may tell it in other words.
pub struct Noting<R> {
    inner: R,
    error: Option<io::Error>,
}

impl<R> Noting<R> {
    /// Reads from `inner`.
    pub fn new(inner: R) -> Self {
        Noting { inner, error: None }
    }

    /// The error met.
    pub fn into_error(self) -> Option<io::Error> {
        self.error
    }
}

impl<R: Read> Read for Noting<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.inner.read(buffer).map_err(|error| {
            let kind = error.kind();
            if kind != io::ErrorKind::Interrupted {
                self.error = Some(error);
            }
            io::Error::from(kind)
        })
    }
}
