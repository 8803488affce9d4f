//! Exact fractions.

use num_rational::Ratio;

use super::integer::{round_scaled, with_sign};
use super::{Integer, NumberError};

/// An exact fraction, always reduced, with a positive denominator.
///
/// Construct one with `Rational::new(numerator, denominator)` (which reduces, and panics on a zero denominator), or
/// `Rational::from_integer`; `is_integer` is a method of the type itself. [`RationalExt`] adds what is particular to this crate.
pub type Rational = Ratio<Integer>;

/// Conversions of [`Rational`] to and from binary64, fixed-point integers and canonical text.
pub trait RationalExt: Sized {
    /// The nearest binary64, ties to even, subnormals included; ±∞ when it rounds beyond the largest finite one.
    fn to_f64(&self) -> f64;

    /// The exact value of a binary64; `None` for NaN and the infinities.
    fn from_f64(value: f64) -> Option<Self>;

    /// ⌊self · 2^bits⌋.
    fn floor_shifted(&self, bits: u32) -> Integer;

    /// ⌈self · 2^bits⌉.
    fn ceil_shifted(&self, bits: u32) -> Integer;

    /// The canonical text: "-3/4", "5".
    fn format(&self) -> String;

    /// Reads canonical text, the inverse of [`format`](RationalExt::format): reduced, no denominator 1, no leading
    /// zeros, no plus sign, no "-0", no spaces. The length is not bounded: bound it where the text comes from.
    ///
    /// # Errors
    /// [`NumberError::Empty`], [`NumberError::Unexpected`], [`NumberError::ZeroDenominator`] and
    /// [`NumberError::NotCanonical`].
    fn parse_canonical(text: &str) -> Result<Self, NumberError>;
}

impl RationalExt for Rational {
    fn to_f64(&self) -> f64 {
        quotient_to_f64(self.numer(), self.denom())
    }

    fn from_f64(value: f64) -> Option<Self> {
        if !value.is_finite() {
            return None;
        }
        let bits = value.to_bits();
        let field = ((bits >> 52) & 0x7ff) as i32;
        let fraction = (bits & ((1 << 52) - 1)) as i64;
        let (magnitude, exponent) = match field {
            0 => (fraction, -1074),
            _ => (fraction | 1 << 52, field - 1075),
        };
        if magnitude == 0 {
            return Some(Rational::from_integer(Integer::ZERO));
        }
        let zeros = magnitude.trailing_zeros();
        let odd = Integer::from(if value < 0.0 {
            -(magnitude >> zeros)
        } else {
            magnitude >> zeros
        });
        let exponent = exponent + zeros as i32;
        let shift = exponent.unsigned_abs();
        // An odd numerator over a power of two is reduced already.
        Some(if exponent >= 0 {
            Rational::from_integer(odd << shift)
        } else {
            Rational::new_raw(odd, Integer::ONE << shift)
        })
    }

    fn floor_shifted(&self, bits: u32) -> Integer {
        (self.numer() << bits).div_floor(self.denom())
    }

    fn ceil_shifted(&self, bits: u32) -> Integer {
        (self.numer() << bits).div_ceil(self.denom())
    }

    fn format(&self) -> String {
        self.to_string()
    }

    fn parse_canonical(text: &str) -> Result<Self, NumberError> {
        let Some((numerator, denominator)) = text.split_once('/') else {
            return text.parse().map(Rational::from_integer);
        };
        // Errors name positions in the whole text.
        let digits = numerator.strip_prefix('-').unwrap_or(numerator);
        let start = numerator.len() - digits.len();
        let slash = numerator.len();
        if Integer::from_digits(digits).is_none() {
            return Err(NumberError::not_digits(text, start, slash));
        }
        let Some(divisor) = Integer::from_digits(denominator) else {
            return Err(NumberError::not_digits(text, slash + 1, text.len()));
        };
        if divisor.is_zero() {
            return Err(NumberError::ZeroDenominator {
                text: super::error::quote(text),
            });
        }
        let refuse = |reason| Err(NumberError::not_canonical(text, reason));
        if digits.starts_with('0') && digits.len() > 1 || denominator.starts_with('0') {
            return refuse("a leading zero");
        }
        if divisor.is_one() {
            return refuse("a denominator 1");
        }
        let numerator: Integer = numerator.parse()?;
        if !numerator.gcd(&divisor).is_one() {
            return refuse("a common factor of numerator and denominator");
        }
        Ok(Rational::new_raw(numerator, divisor))
    }
}

/// The binary64 nearest to numerator / denominator, ties to even; the denominator is positive, the fraction need not
/// be reduced.
pub(crate) fn quotient_to_f64(numerator: &Integer, denominator: &Integer) -> f64 {
    const EXACT: u64 = 1 << 53;
    if let (Some(a), Some(b)) = (numerator.to_i64(), denominator.to_i64())
        && a.unsigned_abs() <= EXACT
        && b.unsigned_abs() <= EXACT
    {
        // One correctly rounded operation on exact operands; an integer zero has no sign.
        return a as f64 / b as f64;
    }
    let negative = numerator.is_negative();
    if denominator.is_power_of_two() {
        let (leading, exponent) = numerator.leading_bits();
        let exponent = i128::from(exponent) - i128::from(denominator.bits() - 1);
        return with_sign(round_scaled(leading, saturate(exponent)), negative);
    }
    // Scale so that the quotient has 62 or 63 bits; the remainder only matters as "not zero".
    let scale = 62 - (numerator.bits() as i64 - denominator.bits() as i64);
    let shift = u32::try_from(scale.unsigned_abs()).unwrap_or(u32::MAX);
    let magnitude = numerator.abs();
    let (quotient, remainder) = if scale >= 0 {
        (magnitude << shift).div_rem(denominator)
    } else {
        magnitude.div_rem(&(denominator << shift))
    };
    let sticky = u64::from(!remainder.is_zero());
    let quotient = quotient.to_u64().unwrap_or(u64::MAX) | sticky;
    with_sign(round_scaled(quotient, -scale), negative)
}

fn saturate(value: i128) -> i64 {
    value.clamp(i128::from(i64::MIN), i128::from(i64::MAX)) as i64
}
