//! Why a run did not come to its end.

use std::fmt;
use std::io;

/// Wrong usage, or a file that cannot be read or written; the text names it.
#[derive(Debug)]
pub struct Failure(String);

impl Failure {
    /// A failure in words.
    pub fn new(text: impl Into<String>) -> Failure {
        Failure(text.into())
    }

    /// A failure at a file.
    pub fn at(file: impl fmt::Display, what: impl fmt::Display) -> Failure {
        Failure(format!("{file}: {what}"))
    }

    /// A failed reading or writing of a file; `doing` as in "cannot be read".
    pub fn io(file: impl fmt::Display, doing: &str, error: &io::Error) -> Failure {
        Failure(format!("{file}: {doing}: {error}"))
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}
