//! Rounded-up logarithms without logarithms.

use crate::number::Rational;

/// ⌈log_b(ratio)⌉ for b = 2^bits: the least integer m, maybe negative, with b^m ≥ `ratio`. `None` for a ratio that is not positive, where every m
/// will do, and for `bits` 0.
///
/// ```
/// use knotproof::approximation::least_power;
/// use knotproof::number::{Integer, Rational};
/// assert_eq!(least_power(&Rational::from_integer(Integer::from(64)), 2), Some(3));
/// assert_eq!(least_power(&Rational::new(Integer::from(65), Integer::from(1)), 2), Some(4));
/// assert_eq!(least_power(&Rational::new(Integer::from(1), Integer::from(16)), 2), Some(-2));
/// ```
pub fn least_power(ratio: &Rational, bits: u32) -> Option<i64> {
    if !ratio.numer().is_positive() || bits == 0 {
        return None;
    }
    let (numerator, denominator) = (ratio.numer(), ratio.denom());
    let reaches = |m: i64| {
        let shift = u32::try_from(m.unsigned_abs() * u64::from(bits)).expect("more bits than memory holds");
        match m >= 0 {
            true => &(denominator << shift) >= numerator,
            false => denominator >= &(numerator << shift),
        }
    };
    // log₂(ratio) is above the difference of bit lengths less 1, so this one does not reach it.
    let mut m = (numerator.bits() as i64 - denominator.bits() as i64 - 1).div_euclid(i64::from(bits));
    while !reaches(m) {
        m += 1;
    }
    Some(m)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::number::Integer;

    #[test]
    fn nothing_to_reach() {
        assert_eq!(least_power(&Rational::default(), 2), None);
        assert_eq!(least_power(&Rational::from_integer(Integer::from(-4)), 2), None);
        assert_eq!(least_power(&Rational::from_integer(Integer::ONE), 0), None);
        assert_eq!(least_power(&Rational::from_integer(Integer::ONE), 4), Some(0));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]

        #[test]
        fn the_least_one(p in 1_u128.., q in 1_u128.., shift in 0_u32..100, bits in 1_u32..5) {
            let ratio = Rational::new(Integer::from(p) << shift, Integer::from(q));
            let m = least_power(&ratio, bits).unwrap();
            let power = |m: i64| {
                let power = Rational::from_integer(Integer::ONE << (m.unsigned_abs() as u32 * bits));
                if m < 0 { Rational::from_integer(Integer::ONE) / power } else { power }
            };
            prop_assert!(power(m) >= ratio && power(m - 1) < ratio);
        }
    }
}
