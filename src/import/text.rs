//! Numbers of text formats.

use crate::number::{Integer, Meaning, Rational, parse_number};

/// The most characters of a number.
const MAXIMUM_LENGTH: usize = 400;
/// The greatest size of a numerator or denominator in bits: arithmetic on numbers of a hostile file must stay quick.
pub(super) const MAXIMUM_BITS: u64 = 4096;

/// Reads a decimal, with an exponent by E or e.
pub(super) fn number(text: &str, meaning: Meaning) -> Result<Rational, String> {
    if text.len() > MAXIMUM_LENGTH {
        return Err(format!(
            "found a number of {} characters, expected at most {MAXIMUM_LENGTH}",
            text.len()
        ));
    }
    if let Some(wrong) = text
        .chars()
        .find(|c| !matches!(c, '0'..='9' | '+' | '-' | '.' | 'e' | 'E'))
    {
        return Err(format!("found {wrong:?} in {text:?}, expected a decimal number"));
    }
    let value = parse_number(text, meaning).map_err(|error| error.to_string())?;
    match small(&value) {
        true => Ok(value),
        false => Err(format!(
            "found {text}, expected a number of at most {MAXIMUM_BITS} bits"
        )),
    }
}

/// Whether a number has a size that is computed with.
pub(super) fn small(value: &Rational) -> bool {
    value.numer().bits() <= MAXIMUM_BITS && value.denom().bits() <= MAXIMUM_BITS
}

/// How many decimals the text of a number has: 2 for "1.25", 3 for "1.2e-2".
pub(super) fn decimals(text: &str) -> u32 {
    let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let fraction = mantissa.split_once('.').map_or(0, |(_, fraction)| fraction.len());
    let exponent: i64 = exponent.parse().unwrap_or(0);
    (fraction as i64 - exponent).clamp(0, i64::from(u16::MAX)) as u32
}

/// One unit of the last of so many decimals.
pub(super) fn unit(decimals: u32) -> Rational {
    Rational::new(Integer::ONE, Integer::from(10).pow(decimals))
}

/// A small integer as a fraction.
pub(super) fn whole(value: i64) -> Rational {
    Rational::from_integer(Integer::from(value))
}

/// A fraction of small integers; the denominator is not 0.
pub(super) fn ratio(numerator: i64, denominator: i64) -> Rational {
    Rational::new(Integer::from(numerator), Integer::from(denominator))
}

/// The absolute value.
pub(super) fn abs(x: &Rational) -> Rational {
    if x.numer().is_negative() { -x } else { x.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_of_texts() {
        for (text, expected) in [
            ("1", 0),
            ("1.25", 2),
            (".5", 1),
            ("1.2e-2", 3),
            ("1.25e1", 1),
            ("5e3", 0),
        ] {
            assert_eq!(decimals(text), expected, "{text}");
        }
        assert_eq!(unit(2), ratio(1, 100));
    }

    #[test]
    fn only_decimals_of_bounded_size() {
        assert_eq!(number("-1.5e1", Meaning::Decimal), Ok(whole(-15)));
        assert_eq!(number("0.1", Meaning::Decimal), Ok(ratio(1, 10)));
        assert_ne!(number("0.1", Meaning::Binary64), Ok(ratio(1, 10)));
        for text in ["1/2", "0x1", "nan", "", "1e9000", "1e-9000", "1 2", "--1"] {
            assert!(number(text, Meaning::Decimal).is_err(), "{text}");
        }
        assert!(number(&"1".repeat(500), Meaning::Decimal).is_err());
    }
}
