//! Exact numbers in sentences.

use crate::number::{Rational, RationalExt, decimal_down};

/// The longest fraction written out.
const LONGEST: usize = 40;
/// Digits of what is not.
const DIGITS: usize = 20;

/// A fraction when it is short, else the first digits of its decimal and an ellipsis.
pub(super) fn number(exact: &Rational) -> String {
    if exact.numer().bits() + exact.denom().bits() < 140 {
        let text = exact.format();
        if text.len() <= LONGEST {
            return text;
        }
    }
    let digits = decimal_down(exact, DIGITS);
    if digits.contains('e') {
        digits
    } else {
        format!("{digits}…")
    }
}

pub(super) fn point(exact: &[Rational]) -> String {
    let numbers: Vec<String> = exact.iter().map(number).collect();
    format!("({})", numbers.join(", "))
}

pub(super) fn floats(found: &[f64]) -> String {
    let numbers: Vec<String> = found.iter().map(f64::to_string).collect();
    format!("({})", numbers.join(", "))
}

/// A number of units, to three digits.
pub(super) fn ulps(ulps: f64) -> String {
    match ulps {
        x if x < 1000.0 => format!("{} units", (x * 10.0).round() / 10.0),
        x => format!("{x:.2e} units"),
    }
}
