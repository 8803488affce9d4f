//! Binary64 neighbours of integers, by correct rounding.

use super::{Integer, Large, Small, backend};

impl Integer {
    /// The nearest binary64, ties to even; ±∞ when the value rounds beyond the largest finite one.
    pub fn to_f64(&self) -> f64 {
        match &self.0 {
            // The conversion rounds to nearest, ties to even, by definition of the language.
            Small(value) => *value as f64,
            Large(_) => {
                let (leading, exponent) = self.leading_bits();
                let exponent = i64::try_from(exponent).unwrap_or(i64::MAX);
                with_sign(round_scaled(leading, exponent), self.is_negative())
            }
        }
    }

    /// The value as m · 2^e with ½ ≤ |m| < 1, m rounded to nearest, ties to even; (0, 0) for 0.
    pub fn to_f64_exponent(&self) -> (f64, i64) {
        if self.is_zero() {
            return (0.0, 0);
        }
        let (leading, exponent) = self.leading_bits();
        // `leading` has b ≤ 64 bits, so leading · 2^-b lies in [½, 1), and rounds to 1 at most.
        let bits = i64::from(64 - leading.leading_zeros());
        let mantissa = round_scaled(leading, -bits);
        let exponent = i64::try_from(exponent).unwrap_or(i64::MAX).saturating_add(bits);
        let (mantissa, exponent) = if mantissa == 1.0 {
            (0.5, exponent.saturating_add(1))
        } else {
            (mantissa, exponent)
        };
        (with_sign(mantissa, self.is_negative()), exponent)
    }

    /// (leading, e) with |self| = leading · 2^e up to bits that only matter as "not zero": when bits are cut off, the
    /// lowest of the 64 leading bits is set if any of them is (rounding to 62 bits or fewer is not disturbed).
    pub(crate) fn leading_bits(&self) -> (u64, u64) {
        match &self.0 {
            Small(value) => (value.unsigned_abs(), 0),
            Large(value) => {
                let exponent = backend::bits(value) - 64;
                let sticky = u64::from(backend::trailing_zeros(value) < exponent);
                (backend::leading_64(value) | sticky, exponent)
            }
        }
    }
}

/// The binary64 nearest to magnitude · 2^exponent, ties to even, subnormals included; +∞ on overflow.
pub(crate) fn round_scaled(magnitude: u64, exponent: i64) -> f64 {
    const LEAST_EXPONENT: i64 = -1074;
    if magnitude == 0 {
        return 0.0;
    }
    let leading_exponent = exponent.saturating_add(63 - i64::from(magnitude.leading_zeros()));
    if leading_exponent > 1023 {
        return f64::INFINITY;
    }
    if leading_exponent < LEAST_EXPONENT - 1 {
        return 0.0;
    }
    // The unit in the last place is 2^unit, and magnitude · 2^exponent = magnitude / 2^shift units.
    let unit = (leading_exponent - 52).max(LEAST_EXPONENT);
    let shift = unit - exponent;
    let units = if shift <= 0 {
        magnitude << -shift
    } else {
        // Here shift ≤ 64: the leading bit has weight at least half a unit.
        let wide = u128::from(magnitude);
        let floor = wide >> shift;
        let half = 1_u128 << (shift - 1);
        let rest = wide - (floor << shift);
        let up = rest > half || (rest == half && floor & 1 == 1);
        (floor + u128::from(up)) as u64
    };
    // The leading bit of 53, if there, adds 1 to the exponent field, as does a carry out of them; a carry beyond the
    // largest finite number gives the encoding of +∞.
    f64::from_bits((((unit - LEAST_EXPONENT) as u64) << 52) + units)
}

pub(crate) fn with_sign(magnitude: f64, negative: bool) -> f64 {
    if negative { -magnitude } else { magnitude }
}
