//! Statements about the thickness, for programs and for people.

use knotproof::claim::msd::Lower;
use knotproof::claim::thickness::Statement;
use knotproof::number::{Rational, RationalExt, sqrt_decimal_down, sqrt_decimal_up};
use serde::Serialize;

use super::curvature_words::roots;

/// At least so many digits are printed for programs.
const DIGITS_FOR_PROGRAMS: usize = 17;
/// At least so many digits of an interval are printed for people.
const DIGITS_FOR_PEOPLE: usize = 6;

/// A statement as JSON.
#[derive(Serialize)]
pub struct ThicknessLine {
    /// Which chords count.
    pub convention: &'static str,
    /// Exact fractions, or "inf".
    lower_squared: String,
    upper_squared: Option<String>,
    /// Decimals rounded outward, or "inf".
    lower: String,
    upper: Option<String>,
}

impl ThicknessLine {
    /// The statement's own fields, with outward decimals of their roots.
    pub fn new(statement: &Statement) -> ThicknessLine {
        let (lower, upper) = decimals(statement, DIGITS_FOR_PROGRAMS);
        ThicknessLine {
            convention: statement.convention.name(),
            lower_squared: match &statement.lower_squared {
                Lower::Infinite => "inf".into(),
                Lower::Finite(lower) => lower.format(),
            },
            upper_squared: statement.upper_squared.as_ref().map(Rational::format),
            lower: lower.unwrap_or_else(|| "inf".into()),
            upper,
        }
    }
}

/// Nothing for an infinite lower bound and for no upper one.
fn decimals(statement: &Statement, digits: usize) -> (Option<String>, Option<String>) {
    match (&statement.lower_squared, &statement.upper_squared) {
        (Lower::Finite(lower), Some(upper)) => {
            let [lower, upper] = roots(lower, upper, digits);
            (Some(lower), Some(upper))
        }
        (Lower::Finite(lower), None) => (Some(sqrt_decimal_down(lower, digits)), None),
        (Lower::Infinite, upper) => (None, upper.as_ref().map(|upper| sqrt_decimal_up(upper, digits))),
    }
}

/// What the number is called: the pipe radius of a closed curve is the reach of an open one.
pub fn subject(closed: bool) -> &'static str {
    if closed { "thickness" } else { "reach" }
}

/// What a statement says, for people.
pub fn in_words(statement: &Statement, closed: bool) -> String {
    let subject = subject(closed);
    match decimals(statement, DIGITS_FOR_PEOPLE) {
        (None, _) => format!("the {subject} is infinite"),
        (Some(lower), Some(upper)) if lower == upper => format!("the {subject} is exactly {lower}"),
        (Some(lower), Some(upper)) => format!("the {subject} is between {lower} and {upper}"),
        (Some(lower), None) => format!("the {subject} is at least {lower}"),
    }
}
