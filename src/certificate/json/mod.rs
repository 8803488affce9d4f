//! The JSON form, and the header of the binary form (FORMAT §4).

mod raw;
mod read;
mod write;

pub use read::{read, read_header};
pub use write::{header, write};
