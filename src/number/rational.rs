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
    if let (Some(a), Some(b), 0..) = (numerator.to_i64(), denominator.to_i64(), scale) {
        // Here |a| · 2^shift < 2^(62 + 63).
        let (a, b) = (u128::from(a.unsigned_abs()) << shift, b as u128);
        let sticky = u64::from(a % b != 0);
        return with_sign(round_scaled((a / b) as u64 | sticky, -scale), negative);
    }
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

#[cfg(test)]
mod tests {
    use std::cmp::Ordering;

    use proptest::prelude::*;

    use super::*;
    use crate::number::generate::{finite, integers, rationals};

    /// |x − y|.
    fn distance(x: &Rational, y: f64) -> Rational {
        let difference = x - Rational::from_f64(y).unwrap();
        if difference.numer().is_negative() {
            -difference
        } else {
            difference
        }
    }

    /// `rounded` is the nearest binary64 by definition: no neighbour is nearer, ties are even.
    fn assert_nearest(x: &Rational, rounded: f64) {
        if rounded.is_infinite() {
            // Halfway between the largest finite number and 2^1024, and all beyond.
            let edge = Rational::from_integer(Integer::from((1_i64 << 54) - 1) << 970);
            let edge = if rounded < 0.0 { -edge } else { edge };
            assert!(if rounded < 0.0 { *x <= edge } else { *x >= edge });
            return;
        }
        let here = distance(x, rounded);
        for neighbour in [rounded.next_up(), rounded.next_down()] {
            if neighbour.is_finite() {
                match here.cmp(&distance(x, neighbour)) {
                    Ordering::Less => {}
                    Ordering::Equal => assert_eq!(rounded.to_bits() & 1, 0, "{x}"),
                    Ordering::Greater => panic!("{x} is nearer to {neighbour} than to {rounded}"),
                }
            }
        }
    }

    #[test]
    fn overflow_and_underflow() {
        let large = Rational::new((Integer::ONE << 1030) + Integer::ONE, Integer::from(3));
        assert_eq!(large.to_f64(), f64::INFINITY);
        assert_eq!((-&large).to_f64(), f64::NEG_INFINITY);
        let tiny = large.recip() * Rational::new(Integer::ONE, Integer::ONE << 50);
        assert_eq!(tiny.to_f64(), 0.0);
        let third_of_least = Rational::new(Integer::ONE, (Integer::ONE << 1074) * Integer::from(3));
        assert_eq!(third_of_least.to_f64(), 0.0);
        let two = Rational::from_integer(Integer::from(2));
        assert_eq!((third_of_least * two).to_f64(), f64::from_bits(1));
        assert_eq!(Rational::new(Integer::ONE, Integer::ONE << 1075).to_f64(), 0.0);
        assert_eq!(
            Rational::new(Integer::from(3), Integer::ONE << 1075).to_f64(),
            f64::from_bits(2)
        );
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(Rational::from_f64(value), None);
        }
        assert_eq!(Rational::from_f64(-0.0).unwrap().to_string(), "0");
    }

    #[test]
    fn canonical_texts_refused() {
        for (text, expected) in [
            ("2/4", "common factor"),
            ("0/5", "common factor"),
            ("5/1", "denominator 1"),
            ("05", "leading zero"),
            ("1/02", "leading zero"),
            ("-01/2", "leading zero"),
            ("-0", "negative zero"),
            ("-0/3", "negative zero"),
            ("1/0", "is zero"),
            ("+1/2", "character 1"),
            ("1/-2", "character 3"),
            ("1/+2", "character 3"),
            ("1//2", "character 3"),
            ("1/2/3", "character 4"),
            ("1 /2", "character 2"),
            ("1/2 ", "character 4"),
            ("1.5", "character 2"),
            ("1e3", "character 2"),
            ("x/2", "character 1"),
            ("-/2", "character 2"),
            ("/2", "character 1"),
            ("1/", "ends"),
            ("-", "ends"),
            ("", "empty"),
        ] {
            let error = Rational::parse_canonical(text).unwrap_err().to_string();
            assert!(error.contains(expected), "{text:?}: {error}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]

        #[test]
        fn to_f64_is_nearest(x in rationals()) {
            assert_nearest(&x, x.to_f64());
        }

        #[test]
        fn to_f64_is_nearest_over_all_exponents(x in rationals(), shift in 0_u32..1400, up in any::<bool>()) {
            let power = Rational::from_integer(Integer::ONE << shift);
            let x = if up { x * power } else { x / power };
            assert_nearest(&x, x.to_f64());
        }

        #[test]
        fn to_f64_of_ties(a in finite(), nudge in -1_i64..=1) {
            // The middle between neighbours, exactly or displaced by a hair.
            let b = if a.next_up().is_finite() { a.next_up() } else { a.next_down() };
            let sum = Rational::from_f64(a).unwrap() + Rational::from_f64(b).unwrap();
            let middle = sum / Rational::from_integer(Integer::from(2));
            let hair = Rational::new(Integer::from(nudge), Integer::from(3) << 1300);
            let x = middle + hair;
            assert_nearest(&x, x.to_f64());
        }

        #[test]
        fn from_f64_is_exact(value in finite()) {
            let exact = Rational::from_f64(value).unwrap();
            prop_assert_eq!(exact.to_f64(), value);
            // Reduced by construction, so constructing it again changes nothing.
            let again = Rational::new(exact.numer().clone(), exact.denom().clone());
            prop_assert_eq!((exact.numer(), exact.denom()), (again.numer(), again.denom()));
            prop_assert!(exact.denom().is_power_of_two());
        }

        #[test]
        fn shifted_floor_and_ceiling(x in rationals(), bits in 0_u32..150) {
            let scaled = &x * Rational::from_integer(Integer::ONE << bits);
            let one = Rational::from_integer(Integer::ONE);
            let floor = Rational::from_integer(x.floor_shifted(bits));
            let ceiling = Rational::from_integer(x.ceil_shifted(bits));
            prop_assert!(floor <= scaled && scaled < &floor + &one);
            prop_assert!(ceiling >= scaled && scaled > &ceiling - &one);
            prop_assert_eq!(floor == ceiling, scaled.is_integer());
        }

        #[test]
        fn canonical_text_round_trip(x in rationals()) {
            let text = x.format();
            prop_assert_eq!(Rational::parse_canonical(&text), Ok(x));
        }

        #[test]
        fn canonical_text_is_unique(a in integers(), b in integers()) {
            let text = format!("{a}/{b}");
            match Rational::parse_canonical(&text) {
                Ok(x) => prop_assert_eq!(x.format(), text),
                Err(_) => prop_assert!(!b.is_positive() || b.is_one() || !a.gcd(&b).is_one()),
            }
        }

        #[test]
        fn field_laws(x in rationals(), y in rationals(), z in rationals()) {
            prop_assert_eq!(&x * (&y + &z), &x * &y + &x * &z);
            prop_assert_eq!(&x - &y + &y, x.clone());
            if !y.numer().is_zero() {
                prop_assert_eq!(&x / &y * &y, x);
            }
        }
    }
}
