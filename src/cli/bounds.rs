//! Bounds of σ as decimals rounded outward, and in words.

use knotproof::claim::msd::{Lower, Statement};
use knotproof::number::{Rational, RationalExt, interval_digits, sqrt_decimal_down, sqrt_decimal_up, sqrt_enclosure};
use serde::Serialize;

/// Digits of a bound that stands alone.
const DIGITS_ALONE: usize = 17;
/// At least so many digits of an interval are printed for people.
const DIGITS_AT_LEAST: usize = 6;
/// √ is enclosed this closely before widths are computed; 1e-30 is 2^-100.
const ROOT_BITS: u32 = 256;

/// The bounds of a statement, exactly and as decimals.
#[derive(Serialize)]
pub struct Bounds {
    /// The lower bound of σ² as a fraction, or "inf".
    pub lower_squared: String,
    /// The upper bound of σ² as a fraction, if there is one.
    pub upper_squared: Option<String>,
    /// A decimal at most σ, or "inf".
    pub lower: String,
    /// A decimal at least σ, if there is an upper bound.
    pub upper: Option<String>,
}

impl Bounds {
    /// The bounds of `statement`, with at least the digits that a binary64 needs.
    pub fn new(statement: &Statement) -> Bounds {
        let (lower, upper) = decimals(statement, DIGITS_ALONE);
        Bounds {
            lower_squared: match &statement.lower_squared {
                Lower::Infinite => "inf".into(),
                Lower::Finite(squared) => squared.format(),
            },
            upper_squared: statement.upper_squared.as_ref().map(Rational::format),
            lower: lower.unwrap_or_else(|| "inf".into()),
            upper,
        }
    }
}

/// The decimals of the bounds, enough digits to tell them apart and at least `digits`; nothing for "inf" and for no bound.
fn decimals(statement: &Statement, digits: usize) -> (Option<String>, Option<String>) {
    let lower = match &statement.lower_squared {
        Lower::Infinite => None,
        Lower::Finite(squared) => Some(squared),
    };
    let upper = statement.upper_squared.as_ref();
    let digits = match (lower, upper) {
        (Some(lower), Some(upper)) if !lower.numer().is_zero() => {
            let (lower, upper) = (sqrt_enclosure(lower, ROOT_BITS).0, sqrt_enclosure(upper, ROOT_BITS).1);
            interval_digits(&lower, &upper).max(digits)
        }
        _ => DIGITS_ALONE,
    };
    (
        lower.map(|squared| sqrt_decimal_down(squared, digits)),
        upper.map(|squared| sqrt_decimal_up(squared, digits)),
    )
}

/// An upper bound of (upper − lower)/upper as a short decimal; nothing without two bounds above 0.
#[cfg(feature = "prove")]
pub fn relative_width(statement: &Statement) -> Option<String> {
    let lower = match &statement.lower_squared {
        Lower::Finite(lower) if !lower.numer().is_zero() => lower,
        _ => return None,
    };
    let upper = statement.upper_squared.as_ref()?;
    let (lower, upper) = (sqrt_enclosure(lower, ROOT_BITS).0, sqrt_enclosure(upper, ROOT_BITS).1);
    Some(knotproof::number::decimal_up(&((&upper - lower) / &upper), 2))
}

/// What a statement says of σ, for people, without a verb at its beginning.
pub fn in_words(statement: &Statement) -> String {
    match decimals(statement, DIGITS_AT_LEAST) {
        (None, _) => "there is no double normal, σ is infinite".into(),
        (Some(_), Some(upper)) if upper == "0" => "σ is 0, the curve passes twice through a point".into(),
        (Some(lower), Some(upper)) if lower == upper => format!("σ is exactly {lower}"),
        (Some(lower), Some(upper)) if lower == "0" => {
            format!("σ at most {upper}, no lower bound above 0")
        }
        (Some(lower), Some(upper)) => format!("σ between {lower} and {upper}"),
        (Some(lower), None) if lower == "0" => {
            "nothing about σ, neither a lower bound above 0 nor an upper bound".into()
        }
        (Some(lower), None) => format!("σ at least {lower}, no upper bound"),
    }
}

/// A number of leaves.
pub fn leaves_in_words(leaves: u64) -> String {
    match leaves {
        1 => "1 leaf".into(),
        _ => format!("{leaves} leaves"),
    }
}
