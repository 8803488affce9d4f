//! Why a curve file was refused.

use std::fmt;

use crate::curve::CurveFault;
use crate::number::NumberError;

/// The reason a curve file was refused, with its place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ReadError {
    /// The JSON path, as `bspline.points[3][1]`; empty for the whole document.
    pub path: String,
    /// What is wrong there.
    pub fault: ReadFault,
}

/// A place in the text of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Position {
    /// The line, from 1.
    pub line: usize,
    /// The column in bytes, from 1; 0 for the end of the line before.
    pub column: usize,
}

/// What is wrong with a curve file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ReadFault {
    /// The bytes are not UTF-8.
    NotUtf8 {
        /// The number of valid bytes before the first invalid one.
        offset: usize,
    },
    /// The text is not JSON; a bare NaN or Infinity is such a case.
    Syntax {
        /// What the JSON reader found.
        message: String,
        /// Where.
        at: Position,
    },
    /// A field that curve files do not have.
    UnknownField {
        /// The field found and the fields expected.
        message: String,
        /// Where.
        at: Position,
    },
    /// A field that must be there is not.
    MissingField {
        /// The field expected.
        message: String,
        /// Where.
        at: Position,
    },
    /// A field occurs twice.
    DuplicateField {
        /// The field.
        message: String,
        /// Where.
        at: Position,
    },
    /// A JSON value of another type than expected.
    WrongType {
        /// The type found and the type expected.
        message: String,
        /// Where.
        at: Position,
    },
    /// The document is not of the version this reader knows.
    Version {
        /// The version found.
        found: String,
    },
    /// `numbers` is neither `decimal` nor `binary64`.
    Meaning {
        /// The text found.
        found: String,
    },
    /// Neither `bspline` nor `bezier` is there.
    NoForm,
    /// Both `bspline` and `bezier` are there.
    TwoForms,
    /// A JSON value that is neither a string nor a number stands for a number.
    NotANumber {
        /// What stands there.
        found: String,
    },
    /// The text of a number was refused.
    Number(NumberError),
    /// The data is not a curve.
    Curve(CurveFault),
    /// `closed` is true, and the two ends differ.
    NotClosed,
    /// `closed` is false, and the two ends coincide.
    NotOpen,
    /// The numbers over their common denominators would take more memory than accepted.
    TooLarge {
        /// The size in bits.
        found: u64,
        /// The largest size accepted.
        limit: u64,
    },
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.path.is_empty() {
            write!(f, "{}: ", self.path)?;
        }
        self.fault.fmt(f)
    }
}

impl std::error::Error for ReadError {}

impl fmt::Display for Position {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {} column {}", self.line, self.column)
    }
}

impl fmt::Display for ReadFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ReadFault::NotUtf8 { offset } => {
                write!(f, "found bytes that are not UTF-8 at byte {offset}, expected JSON")
            }
            ReadFault::Syntax { message, at } => write!(f, "{at}: {message}, expected JSON"),
            ReadFault::UnknownField { message, at }
            | ReadFault::MissingField { message, at }
            | ReadFault::DuplicateField { message, at }
            | ReadFault::WrongType { message, at } => write!(f, "{at}: {message}"),
            ReadFault::Version { found } => {
                write!(f, "found version {found:?}, expected {:?}", super::VERSION)
            }
            ReadFault::Meaning { found } => {
                write!(f, "found {found:?}, expected \"decimal\" or \"binary64\"")
            }
            ReadFault::NoForm => {
                write!(f, "found neither bspline nor bezier, expected one of them")
            }
            ReadFault::TwoForms => write!(f, "found both bspline and bezier, expected one of them"),
            ReadFault::NotANumber { found } => {
                write!(f, "found {found}, expected a number or a string with the text of one")
            }
            ReadFault::Number(error) => error.fmt(f),
            ReadFault::Curve(fault) => fault.fmt(f),
            ReadFault::NotClosed => write!(
                f,
                "found true, but the two ends of the curve differ; expected a curve closed exactly"
            ),
            ReadFault::NotOpen => write!(
                f,
                "found false, but the two ends of the curve coincide; expected an open curve"
            ),
            ReadFault::TooLarge { found, limit } => {
                write!(f, "found numbers of {found} bits together, expected at most {limit}")
            }
        }
    }
}
