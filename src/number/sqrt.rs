//! Square roots of fractions, enclosed.

use super::{Integer, Rational};

/// Two fractions (lower, upper) with lower ≤ √x ≤ upper.
///
/// When x is the square of a fraction both are that fraction. Otherwise both are dyadic, lower < √x < upper, and
/// upper − lower ≤ 2^-bits · √x.
///
/// # Panics
/// When x is negative.
///
/// ```
/// use knotproof::number::{Integer, Rational, sqrt_enclosure};
/// let two = Rational::from_integer(Integer::from(2));
/// let (lower, upper) = sqrt_enclosure(&two, 53);
/// assert!(&lower * &lower < two && two < &upper * &upper);
/// ```
pub fn sqrt_enclosure(x: &Rational, bits: u32) -> (Rational, Rational) {
    assert!(!x.numer().is_negative(), "square root of a negative number");
    if let Some(root) = exact_sqrt(x) {
        return (root.clone(), root);
    }
    // √x > 2^(decade), so a spacing of 2^(decade - bits) is narrow enough.
    let decade = (x.numer().bits() as i64 - x.denom().bits() as i64 - 1).div_euclid(2);
    let exponent = i64::from(bits) - decade;
    let shift = u32::try_from(2 * exponent.unsigned_abs()).expect("more bits than memory holds");
    let scaled = if exponent >= 0 {
        (x.numer() << shift).div_floor(x.denom())
    } else {
        x.numer().div_floor(&(x.denom() << shift))
    };
    // ⌊√⌊y⌋⌋ = ⌊√y⌋, and √y is no integer here.
    let root = scaled.sqrt_floor().unwrap_or_default();
    let next = &root + Integer::ONE;
    (scale(root, -exponent), scale(next, -exponent))
}

/// √x when it is a fraction; `None` for other and for negative numbers.
pub fn exact_sqrt(x: &Rational) -> Option<Rational> {
    let root = |square: &Integer| {
        let root = square.sqrt_floor()?;
        (&root * &root == *square).then_some(root)
    };
    // In a reduced square fraction both parts are squares.
    Some(Rational::new_raw(root(x.numer())?, root(x.denom())?))
}

/// value · 2^exponent.
fn scale(value: Integer, exponent: i64) -> Rational {
    let shift = exponent.unsigned_abs() as u32;
    if exponent >= 0 {
        Rational::from_integer(value << shift)
    } else {
        Rational::new(value, Integer::ONE << shift)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::number::generate::{positive_rationals, rationals};

    #[test]
    fn zero_and_squares() {
        let zero = Rational::from_integer(Integer::ZERO);
        assert_eq!(sqrt_enclosure(&zero, 10), (zero.clone(), zero));
        let square = Rational::new(Integer::from(9), Integer::from(16));
        let root = Rational::new(Integer::from(3), Integer::from(4));
        assert_eq!(sqrt_enclosure(&square, 0), (root.clone(), root));
        assert_eq!(exact_sqrt(&Rational::new(Integer::from(9), Integer::from(2))), None);
        assert_eq!(exact_sqrt(&Rational::from_integer(Integer::from(-4))), None);
    }

    #[test]
    #[should_panic(expected = "square root of a negative number")]
    fn negative_numbers_panic() {
        sqrt_enclosure(&Rational::from_integer(Integer::from(-1)), 10);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]

        #[test]
        fn encloses_narrowly(x in positive_rationals(), shift in 0_u32..400, bits in 0_u32..200) {
            let power = Rational::from_integer(Integer::ONE << shift);
            for x in [&x * &power, &x / &power] {
                let (lower, upper) = sqrt_enclosure(&x, bits);
                prop_assert!(&lower * &lower <= x && x <= &upper * &upper);
                // Relative to the lower end, hence to the root.
                let widened = (&upper - &lower) * Rational::from_integer(Integer::ONE << bits);
                prop_assert!(widened <= lower);
                if lower != upper {
                    prop_assert!(lower.denom().is_power_of_two() && upper.denom().is_power_of_two());
                    prop_assert!(&lower * &lower < x && x < &upper * &upper);
                }
            }
        }

        #[test]
        fn exact_for_squares(x in rationals(), bits in 0_u32..100) {
            let (lower, upper) = sqrt_enclosure(&(&x * &x), bits);
            let magnitude = if x.numer().is_negative() { -x } else { x };
            prop_assert_eq!(&lower, &magnitude);
            prop_assert_eq!(upper, magnitude);
        }
    }
}
