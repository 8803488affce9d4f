//! The JSON form, and the header of the binary form (FORMAT §4, §9).

mod curvature;
mod deviation;
mod domain;
mod embedding;
mod msd;
mod numbers;
mod raw;
mod read;
mod thickness;
mod tree;
mod values;
mod write;

pub use read::{read, read_header};
pub use write::{header, write};
