//! Why a file of cases or results was refused.

use std::fmt;

/// What is wrong with a file, and where.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileError {
    /// The JSON path, as `results[3].point[1]`; empty for the whole document.
    pub path: String,
    /// What was found and what was expected.
    pub what: String,
}

impl FileError {
    pub(super) fn new(path: impl Into<String>, what: impl Into<String>) -> FileError {
        FileError {
            path: path.into(),
            what: what.into(),
        }
    }
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.path.is_empty() {
            write!(f, "{}: ", self.path)?;
        }
        f.write_str(&self.what)
    }
}

impl std::error::Error for FileError {}
