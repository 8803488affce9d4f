//! Why a motion file was refused.

use std::fmt;
use std::io;

/// The reason a motion file was refused, with its place.
#[derive(Debug)]
pub struct MotionError {
    /// The line or JSON path, as `steps[3].moves[0].by[1]`; empty for the whole file.
    pub place: String,
    /// What was found there, and what was expected.
    pub what: String,
}

impl MotionError {
    pub(crate) fn new(place: impl Into<String>, what: impl Into<String>) -> MotionError {
        MotionError {
            place: place.into(),
            what: what.into(),
        }
    }

    /// The second reading found something else than the first.
    pub(super) fn changed(place: &str) -> MotionError {
        MotionError::new(place, "the file was changed while it was read")
    }

    /// The same with a place around it.
    pub(super) fn within(self, place: &str) -> MotionError {
        let joint = match (place.is_empty(), self.place.is_empty()) {
            (true, _) | (_, true) => "",
            _ if place.starts_with("line ") => ": ",
            _ if self.place.starts_with('[') => "",
            _ => ".",
        };
        MotionError {
            place: format!("{place}{joint}{}", self.place),
            what: self.what,
        }
    }
}

impl fmt::Display for MotionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.place.is_empty() {
            f.write_str(&self.what)
        } else {
            write!(f, "{}: {}", self.place, self.what)
        }
    }
}

impl std::error::Error for MotionError {}

impl From<io::Error> for MotionError {
    fn from(error: io::Error) -> Self {
        MotionError::new("", format!("cannot be read: {error}"))
    }
}
