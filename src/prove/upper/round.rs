//! Fractions with few bits.

use crate::number::{Integer, Rational, RationalExt, simplest_between};

pub(super) fn integer(value: usize) -> Rational {
    Rational::from_integer(value.into())
}

pub(super) fn power_of_two(bits: u32) -> Rational {
    Rational::new(Integer::from(1), Integer::from(1) << bits)
}

/// The rational nearest to `x` with denominator 2^bits.
pub(super) fn rounded(x: &Rational, bits: u32) -> Rational {
    let half = Rational::new(Integer::from(1), Integer::from(2));
    Rational::new(
        (x * Rational::from_integer(Integer::from(1) << bits) + half)
            .floor()
            .to_integer(),
        Integer::from(1) << bits,
    )
}

/// A fraction with few bits in the closed interval [low, high] of positive numbers, whose width is about `relative` times them.
pub fn few_bits_between(low: &Rational, high: &Rational, relative: f64) -> Rational {
    // First inwards to multiples of a power of two, so that the search for the simplest fraction has small numbers.
    let size = low.numer().bits() as f64 - low.denom().bits() as f64;
    let bits = (4.0 - relative.log2() - size).ceil();
    if !(0.0..10_000.0).contains(&bits) {
        return simplest_between(low, high);
    }
    let unit = Integer::from(1) << bits as u32;
    let (inner_low, inner_high) = (low.ceil_shifted(bits as u32), high.floor_shifted(bits as u32));
    if inner_low > inner_high {
        return simplest_between(&low.reduced(), &high.reduced());
    }
    simplest_between(
        &Rational::new(inner_low, unit.clone()),
        &Rational::new(inner_high, unit),
    )
}

/// The product of fractions, not reduced.
pub fn raw_product(factors: &[&Rational]) -> Rational {
    let product = |part: fn(&Rational) -> &Integer| {
        factors
            .iter()
            .fold(Integer::from(1), |product, factor| product * part(factor))
    };
    Rational::new_raw(product(Rational::numer), product(Rational::denom))
}
