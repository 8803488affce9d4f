//! Many fractions over one common denominator.

use super::rational::quotient_to_f64;
use super::{Integer, Rational};

/// Rational numbers over one common denominator, kept at the least one: the denominator is positive, and no integer
/// above 1 divides it and all numerators. Equality is therefore equality of the numbers.
///
/// ```
/// use knotproof::number::{Integer, Rational, RationalVector};
/// let third = Rational::new(Integer::from(1), Integer::from(3));
/// let half = Rational::new(Integer::from(1), Integer::from(2));
/// let vector = RationalVector::from_rationals(&[third, half]);
/// assert_eq!(vector.denominator(), &Integer::from(6));
/// assert_eq!(vector.numerators(), [Integer::from(2), Integer::from(3)]);
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct RationalVector {
    denominator: Integer,
    numerators: Vec<Integer>,
}

impl Default for RationalVector {
    /// No numbers, over denominator 1.
    fn default() -> Self {
        RationalVector {
            denominator: Integer::ONE,
            numerators: Vec::new(),
        }
    }
}

impl RationalVector {
    /// The given numbers, in order.
    pub fn from_rationals(numbers: &[Rational]) -> Self {
        Self::from_rationals_within(numbers, u64::MAX).expect("no limit")
    }

    /// The given numbers, in order; `None` as soon as their common denominator has more than `maximum_bits` bits, so that many
    /// small fractions cannot take much space.
    pub fn from_rationals_within(numbers: &[Rational], maximum_bits: u64) -> Option<Self> {
        // The least common multiple, its power of two and its odd part kept apart: most denominators are powers of
        // two, and those need no division.
        let mut shift = 0;
        let mut odd = Integer::ONE;
        let mut last = &Integer::ONE;
        for number in numbers {
            let denominator = number.denom();
            if denominator == last {
                continue;
            }
            last = denominator;
            let (exponent, part) = split(denominator);
            shift = shift.max(exponent);
            if let Some(part) = part
                && !(&odd % &part).is_zero()
            {
                odd = odd.lcm(&part);
            }
            if odd.bits() + u64::from(shift) > maximum_bits {
                return None;
            }
        }
        let denominator = &odd << shift;
        let mut last = &Integer::ONE;
        let mut factor = denominator.clone();
        let numerators = numbers
            .iter()
            .map(|number| {
                if number.denom() != last {
                    last = number.denom();
                    factor = denominator.div_exact(last);
                }
                number.numer() * &factor
            })
            .collect();
        // Each number is reduced, so no prime of the least common multiple divides all numerators.
        Some(RationalVector {
            denominator,
            numerators,
        })
    }

    /// The numbers numerator / denominator for all numerators in order, reduced together; `None` when the denominator is not positive.
    pub fn from_parts(numerators: Vec<Integer>, denominator: Integer) -> Option<Self> {
        if !denominator.is_positive() {
            return None;
        }
        let mut vector = RationalVector {
            denominator,
            numerators,
        };
        vector.reduce();
        Some(vector)
    }

    /// Divides the denominator and all numerators by their greatest common divisor.
    fn reduce(&mut self) {
        let (exponent, odd) = split(&self.denominator);
        let shift = self
            .numerators
            .iter()
            .filter_map(Integer::trailing_zeros)
            .fold(u64::from(exponent), u64::min) as u32;
        let divisor = OddDivisor::common(odd.unwrap_or(Integer::ONE), &self.numerators);
        if shift == 0 && divisor.is_one() {
            return;
        }
        divisor.divide(&mut self.denominator, shift);
        for numerator in &mut self.numerators {
            divisor.divide(numerator, shift);
        }
    }

    /// How many numbers there are.
    pub fn len(&self) -> usize {
        self.numerators.len()
    }

    /// Whether there are no numbers.
    pub fn is_empty(&self) -> bool {
        self.numerators.is_empty()
    }

    /// The number at index `i`.
    ///
    /// # Panics
    /// When `i` is not below [`len`](RationalVector::len), as for slices.
    pub fn get(&self, i: usize) -> Rational {
        Rational::new(self.numerators[i].clone(), self.denominator.clone())
    }

    /// The numbers, in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Rational> + DoubleEndedIterator + '_ {
        self.numerators
            .iter()
            .map(|numerator| Rational::new(numerator.clone(), self.denominator.clone()))
    }

    /// The numerators over [`denominator`](RationalVector::denominator), in order.
    pub fn numerators(&self) -> &[Integer] {
        &self.numerators
    }

    /// The least common denominator, positive.
    pub fn denominator(&self) -> &Integer {
        &self.denominator
    }

    /// Each number's nearest binary64, as [`RationalExt::to_f64`](super::RationalExt::to_f64).
    pub fn to_f64s(&self) -> Vec<f64> {
        self.numerators
            .iter()
            .map(|numerator| quotient_to_f64(numerator, &self.denominator))
            .collect()
    }
}

/// An odd positive integer that is divided by many times. Below 2^63 it comes with its inverse modulo 2^64, which turns
/// an exact division into one multiplication and a test of divisibility into another.
enum OddDivisor {
    Small { value: u64, inverse: u64 },
    Large(Integer),
}

impl OddDivisor {
    fn new(value: Integer) -> Self {
        let Some(value) = value.to_i64() else {
            return OddDivisor::Large(value);
        };
        let value = value as u64;
        // Newton's iteration doubles the correct low bits: 3 at the start, since v · v = 1 modulo 8, then 6, 12, 24, 48, 96.
        let mut inverse = value;
        for _ in 0..5 {
            inverse = inverse.wrapping_mul(2_u64.wrapping_sub(value.wrapping_mul(inverse)));
        }
        OddDivisor::Small { value, inverse }
    }

    /// The greatest common divisor of an odd positive integer and the numerators.
    fn common(odd: Integer, numerators: &[Integer]) -> Self {
        let mut divisor = OddDivisor::new(odd);
        for numerator in numerators {
            if divisor.is_one() {
                break;
            }
            if !divisor.divides(numerator) {
                divisor = OddDivisor::new(divisor.value().gcd(numerator));
            }
        }
        divisor
    }

    fn value(&self) -> Integer {
        match self {
            OddDivisor::Small { value, .. } => Integer::from(*value),
            OddDivisor::Large(value) => value.clone(),
        }
    }

    fn is_one(&self) -> bool {
        matches!(self, OddDivisor::Small { value: 1, .. })
    }

    fn divides(&self, numerator: &Integer) -> bool {
        match (self, numerator.to_i64()) {
            // Multiplication by the inverse permutes the residues and takes the multiples k · value to k.
            (OddDivisor::Small { value, inverse }, Some(numerator)) => {
                numerator.unsigned_abs().wrapping_mul(*inverse) <= u64::MAX / value
            }
            _ => (numerator % self.value()).is_zero(),
        }
    }

    /// number / (2^shift · self), known to leave no remainder.
    fn divide(&self, number: &mut Integer, shift: u32) {
        match (self, number.small_mut()) {
            (OddDivisor::Small { inverse, .. }, Some(number)) => {
                *number = (*number >> shift.min(63)).wrapping_mul(*inverse as i64);
            }
            _ => *number = (&*number >> shift).div_exact(&self.value()),
        }
    }
}

/// Exponent k and odd part of the positive integer 2^k · odd; `None` for the odd part 1.
fn split(denominator: &Integer) -> (u32, Option<Integer>) {
    // Memory bounds integers far below 2^(2^32).
    let exponent = denominator.trailing_zeros().unwrap_or(0) as u32;
    if denominator.bits() == u64::from(exponent) + 1 {
        (exponent, None)
    } else {
        (exponent, Some(denominator >> exponent))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::number::RationalExt;
    use crate::number::generate::{integers, rationals};

    fn is_canonical(vector: &RationalVector) -> bool {
        let divisor = vector
            .numerators()
            .iter()
            .fold(vector.denominator().clone(), |divisor, numerator| {
                divisor.gcd(numerator)
            });
        vector.denominator().is_positive() && divisor.is_one()
    }

    #[test]
    fn without_numbers_and_without_sense() {
        let empty = RationalVector::from_rationals(&[]);
        assert!(empty.is_empty());
        assert_eq!(empty, RationalVector::default());
        assert_eq!(RationalVector::from_parts(vec![], Integer::from(12)), Some(empty));
        for denominator in [0, -1] {
            let numerators = vec![Integer::ONE];
            assert_eq!(RationalVector::from_parts(numerators, Integer::from(denominator)), None);
        }
        let zeros = RationalVector::from_parts(vec![Integer::ZERO; 3], Integer::from(12)).unwrap();
        assert_eq!(zeros.denominator(), &Integer::ONE);
        assert_eq!(zeros.len(), 3);
    }

    #[test]
    fn least_value_of_64_bits() {
        let numerators = vec![Integer::from(i64::MIN), Integer::ONE << 64];
        let vector = RationalVector::from_parts(numerators, Integer::ONE << 63).unwrap();
        assert_eq!(vector.numerators(), [Integer::from(-1), Integer::from(2)]);
        assert_eq!(vector.denominator(), &Integer::ONE);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]

        #[test]
        fn keeps_the_numbers(numbers in prop::collection::vec(rationals(), 0..9)) {
            let vector = RationalVector::from_rationals(&numbers);
            prop_assert!(is_canonical(&vector));
            prop_assert_eq!(vector.len(), numbers.len());
            prop_assert_eq!(vector.iter().collect::<Vec<_>>(), numbers.clone());
            for (i, number) in numbers.iter().enumerate() {
                prop_assert_eq!(&vector.get(i), number);
            }
            let floats: Vec<f64> = numbers.iter().map(RationalExt::to_f64).collect();
            prop_assert_eq!(vector.to_f64s(), floats);
        }

        #[test]
        fn reduces_parts(
            numerators in prop::collection::vec(integers(), 0..9),
            denominator in prop_oneof![integers(), (1_i64..500).prop_map(Integer::from), (0_u32..90).prop_map(|bits| Integer::ONE << bits)],
            factor in prop_oneof![integers(), (1_i64..500).prop_map(Integer::from), (0_u32..90).prop_map(|bits| Integer::ONE << bits)],
        ) {
            let one = |integer: Integer| if integer.is_zero() { Integer::ONE } else { integer.abs() };
            let (denominator, factor) = (one(denominator), one(factor));
            let numbers: Vec<Rational> = numerators
                .iter()
                .map(|numerator| Rational::new(numerator.clone(), denominator.clone()))
                .collect();
            let multiples = numerators.iter().map(|numerator| numerator * &factor).collect();
            let vector = RationalVector::from_parts(multiples, denominator * factor).unwrap();
            prop_assert!(is_canonical(&vector));
            prop_assert_eq!(vector, RationalVector::from_rationals(&numbers));
        }
    }
}
