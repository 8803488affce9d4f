//! The JSON form, and the header of the binary form (FORMAT §4, §9).

mod curvature;
mod deviation;
mod domain;
mod embedding;
mod motion;
mod motion_events;
mod msd;
mod numbers;
mod raw;
mod read;
mod thickness;
mod tree;
mod values;
mod write;

pub use read::{Texts, read, read_header};
pub use write::{header, write};
