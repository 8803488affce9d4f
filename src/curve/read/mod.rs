//! The strict reader of curve files, JSON `curve/1`.

mod convert;
mod document;
mod error;

#[cfg(feature = "prove")]
pub(crate) use convert::read_number;
pub use error::{Position, ReadError, ReadFault};

use super::Curve;

/// The version of curve files that is read and written.
pub const VERSION: &str = "curve/1";

/// The greatest size in bits, all numerators and denominators together, of the numbers of one file.
pub const MAXIMUM_TOTAL_BITS: u64 = 1 << 34;

/// How to read a curve file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ReadOptions {
    /// Where a Bézier piece does not start exactly where the piece before ends, move its start there. When the file asserts
    /// `"closed": true`, the start of the first piece is moved to the end of the last one likewise. How far points move is
    /// not limited; [`CurveFile::snapped`] counts them.
    pub snap_joints: bool,
}

/// What a curve file says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CurveFile {
    /// The free text of its `name` field.
    pub name: Option<String>,
    /// The curve.
    pub curve: Curve,
    /// How many joints [`ReadOptions::snap_joints`] moved; 0 without it.
    pub snapped: usize,
}

/// Reads a curve file of version `curve/1`.
///
/// Sizes are checked before memory is taken in proportion to anything but the input.
///
/// # Errors
/// The first fault found, with its JSON path.
pub fn read_curve(json: impl AsRef<[u8]>) -> Result<CurveFile, ReadError> {
    read_curve_with(json, ReadOptions::default())
}

/// Reads a curve file of version `curve/1` with options.
///
/// # Errors
/// As [`read_curve`].
pub fn read_curve_with(json: impl AsRef<[u8]>, options: ReadOptions) -> Result<CurveFile, ReadError> {
    let json = std::str::from_utf8(json.as_ref()).map_err(|error| ReadError {
        path: String::new(),
        fault: ReadFault::NotUtf8 {
            offset: error.valid_up_to(),
        },
    })?;
    convert::convert(document::parse(json)?, options)
}

fn version_error(found: String) -> ReadError {
    ReadError {
        path: "knotproof".to_string(),
        fault: ReadFault::Version { found },
    }
}
