//! The claim `motion`.

mod obligation;
mod parts;
mod positions;
mod runs;
mod shape;
mod table;

pub use positions::{MotionError, Positions};
pub use shape::{Node, Shape};
pub use table::{Moved, Table, TreeError};
