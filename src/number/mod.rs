//! Exact numbers: integers of any size, fractions, and their texts.

mod error;
mod integer;
mod rational;
mod vector;

pub use error::NumberError;
pub use integer::Integer;
pub use rational::{Rational, RationalExt};
pub use vector::RationalVector;
