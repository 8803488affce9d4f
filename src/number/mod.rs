//! Exact numbers.
//!
//! - [`Integer`]: integers of any size, machine arithmetic while they fit in 64 bits;
//! - [`Rational`]: reduced fractions of them, with [`RationalExt`] for binary64 and canonical text;
//! - [`RationalVector`]: many fractions over one denominator, for work in integers;
//! - [`parse_number`]: decimals, fractions and hexadecimal floats as files write them, where a decimal means either
//!   itself or its nearest binary64 ([`Meaning`]);
//! - [`sqrt_enclosure`], and decimals rounded outward: [`decimal_down`], [`sqrt_decimal_up`] and their like;
//! - [`simplest_between`] and [`approximate`]: fractions with small denominators.
//!
//! Nothing here rounds unless its name or first line says so, and then by a stated rule.

mod approximation;
mod error;
mod integer;
mod parse;
mod print;
mod rational;
mod sqrt;
mod vector;

#[cfg(test)]
mod generate;

pub use approximation::{approximate, simplest_between};
pub use error::NumberError;
pub use integer::Integer;
pub use parse::{MAXIMUM_EXPONENT, MAXIMUM_LENGTH, Meaning, parse_number};
pub use print::{decimal_down, decimal_up, interval_digits, sqrt_decimal_down, sqrt_decimal_up};
pub use rational::{Rational, RationalExt};
pub use sqrt::{exact_sqrt, sqrt_enclosure};
pub use vector::RationalVector;
