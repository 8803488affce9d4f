//! Numbers of the JSON form.

use super::super::FormatError;
use super::raw::Text;
use crate::claim::tree::canonical_integer;
use crate::curve::MAXIMUM_BITS;
use crate::number::{Integer, Rational, RationalExt, RationalVector};

/// The most bits in numerator and denominator of a parameter.
const MOST_PARAMETER_BITS: u64 = 4096;

pub type Parsed<T> = Result<T, FormatError>;

pub fn rational(text: &Text, place: &str) -> Parsed<Rational> {
    let refuse = |what: String| FormatError::malformed(place, what);
    if text.0.len() > 40_000 {
        return Err(refuse("a number of more than 40,000 characters".into()));
    }
    let value = Rational::parse_canonical(&text.0).map_err(|error| {
        refuse(format!(
            "found {:?}, expected a canonical fraction: {error}",
            shortened(&text.0)
        ))
    })?;
    if value.numer().bits() > MAXIMUM_BITS || value.denom().bits() > MAXIMUM_BITS {
        return Err(refuse(format!("a number of more than {MAXIMUM_BITS} bits")));
    }
    Ok(value)
}

/// A fraction that is not negative.
pub fn not_negative(text: &Text, place: &str) -> Parsed<Rational> {
    let value = rational(text, place)?;
    if value.numer().is_negative() {
        return Err(FormatError::malformed(place, "negative"));
    }
    Ok(value)
}

/// A parameter, short enough for powers of it.
pub fn parameter(text: &Text, place: &str) -> Parsed<Rational> {
    let value = rational(text, place)?;
    if value.numer().bits().max(value.denom().bits()) > MOST_PARAMETER_BITS {
        let what = format!("a parameter of more than {MOST_PARAMETER_BITS} bits");
        return Err(FormatError::malformed(place, what));
    }
    Ok(value)
}

pub fn integer(text: &Text, place: &str) -> Parsed<Integer> {
    canonical_integer(&text.0)
        .filter(|integer| integer.bits() <= MAXIMUM_BITS)
        .ok_or_else(|| {
            FormatError::malformed(
                place,
                format!("found {:?}, expected a canonical integer", shortened(&text.0)),
            )
        })
}

pub fn shortened(text: &str) -> String {
    text.chars().take(64).collect()
}

pub fn numbers<'t, 'a: 't>(texts: impl Iterator<Item = &'t Text<'a>>, place: &str) -> Parsed<RationalVector> {
    let numbers: Vec<Rational> = texts.map(|text| rational(text, place)).collect::<Parsed<_>>()?;
    let vector = RationalVector::from_rationals_within(&numbers, MAXIMUM_BITS);
    vector
        .ok_or_else(|| FormatError::malformed(place, format!("a common denominator of more than {MAXIMUM_BITS} bits")))
}

pub fn points(points: &[Vec<Text>], dimension: usize, place: &str) -> Parsed<RationalVector> {
    if let Some(k) = points.iter().position(|point| point.len() != dimension) {
        let what = format!("found {} coordinates, expected {dimension}", points[k].len());
        return Err(FormatError::malformed(format!("{place}[{k}]"), what));
    }
    numbers(points.iter().flatten(), place)
}
