//! Statements about the greatest curvature, for programs and for people.

use knotproof::claim::curvature::Statement;
use knotproof::number::{Rational, RationalExt, interval_digits, sqrt_decimal_down, sqrt_decimal_up, sqrt_enclosure};
use serde::Serialize;

/// At least so many digits are printed for programs.
const DIGITS_FOR_PROGRAMS: usize = 17;
/// At least so many digits of an interval are printed for people.
const DIGITS_FOR_PEOPLE: usize = 6;
/// Roots are enclosed this closely before digits are counted.
const ROOT_BITS: u32 = 256;

/// A statement as JSON.
#[derive(Serialize)]
pub struct CurvatureLine {
    /// Exact fractions.
    lower_squared: String,
    upper_squared: String,
    /// Decimals rounded outward.
    lower: String,
    upper: String,
}

impl CurvatureLine {
    /// The statement's own fields, with outward decimals of their roots.
    pub fn new(statement: &Statement) -> CurvatureLine {
        let [lower, upper] = roots(&statement.lower_squared, &statement.upper_squared, DIGITS_FOR_PROGRAMS);
        CurvatureLine {
            lower_squared: statement.lower_squared.format(),
            upper_squared: statement.upper_squared.format(),
            lower,
            upper,
        }
    }
}

/// Decimals around the roots of two squares, at least so many digits and enough to tell them apart.
pub fn roots(lower_squared: &Rational, upper_squared: &Rational, digits: usize) -> [String; 2] {
    let ends = [
        sqrt_enclosure(lower_squared, ROOT_BITS).0,
        sqrt_enclosure(upper_squared, ROOT_BITS).1,
    ];
    let digits = match lower_squared == upper_squared || lower_squared.numer().is_zero() {
        true => digits,
        false => interval_digits(&ends[0], &ends[1]).max(digits),
    };
    [
        sqrt_decimal_down(lower_squared, digits),
        sqrt_decimal_up(upper_squared, digits),
    ]
}

/// What a statement says, for people.
pub fn in_words(statement: &Statement) -> String {
    let [lower, upper] = roots(&statement.lower_squared, &statement.upper_squared, DIGITS_FOR_PEOPLE);
    if lower == upper {
        format!("the greatest curvature is exactly {lower}")
    } else {
        format!("the greatest curvature is between {lower} and {upper}")
    }
}
