//! Fractions with small denominators.

use super::{Integer, Rational, RationalExt};

/// The fraction of least denominator in the closed interval with the ends `a` and `b`, given in either order; among
/// several integers the one nearest to zero. (The Stern–Brocot tree's topmost node in the interval.)
///
/// ```
/// use knotproof::number::{Rational, RationalExt, simplest_between};
/// let a = Rational::parse_canonical("157/50").unwrap();
/// let b = Rational::parse_canonical("63/20").unwrap();
/// assert_eq!(simplest_between(&a, &b).to_string(), "22/7");
/// ```
pub fn simplest_between(a: &Rational, b: &Rational) -> Rational {
    let (lower, upper) = if a <= b { (a, b) } else { (b, a) };
    if lower.numer().is_positive() {
        simplest_between_positive(lower.clone(), upper.clone())
    } else if upper.numer().is_negative() {
        -simplest_between_positive(-upper, -lower)
    } else {
        Rational::from_integer(Integer::ZERO)
    }
}

/// The same for 0 < lower ≤ upper, by the continued fraction that the two ends have in common.
fn simplest_between_positive(mut lower: Rational, mut upper: Rational) -> Rational {
    let mut convergents = Convergents::new();
    loop {
        let whole = lower.numer().div_ceil(lower.denom());
        if &whole * upper.denom() <= *upper.numer() {
            convergents.push(&whole);
            return convergents.last();
        }
        // No integer between the ends: both lie strictly between two consecutive ones.
        let floor = whole - Integer::ONE;
        convergents.push(&floor);
        let floor = Rational::from_integer(floor);
        (lower, upper) = ((upper - &floor).recip(), (lower - &floor).recip());
    }
}

/// The fraction nearest to `x` among those with a denominator up to `max_denominator`; of two equally near, the one of
/// smaller denominator. `None` when `x` is not finite or `max_denominator` is 0.
///
/// ```
/// use knotproof::number::approximate;
/// assert_eq!(approximate(std::f64::consts::PI, 1000).unwrap().to_string(), "355/113");
/// ```
pub fn approximate(x: f64, max_denominator: u64) -> Option<Rational> {
    let exact = Rational::from_f64(x)?;
    let limit = Integer::from(max_denominator);
    if limit.is_zero() || exact.denom() <= &limit {
        return (!limit.is_zero()).then_some(exact);
    }
    let mut convergents = Convergents::new();
    let (mut numerator, mut denominator) = (exact.numer().clone(), exact.denom().clone());
    // The denominator of x is above the limit, so the loop ends before the remainder is zero.
    loop {
        let quotient = numerator.div_floor(&denominator);
        if convergents.denominator_after(&quotient) > limit {
            break;
        }
        convergents.push(&quotient);
        let remainder = numerator - quotient * &denominator;
        (numerator, denominator) = (denominator, remainder);
    }
    // Best from above and best from below: the last convergent, and the largest intermediate fraction after it.
    let convergent = convergents.last();
    let quotient = (limit - &convergents.denominators[0]).div_floor(&convergents.denominators[1]);
    convergents.push(&quotient);
    let intermediate = convergents.last();
    let distance = |candidate: &Rational| {
        let difference = candidate - &exact;
        if difference.numer().is_negative() {
            -difference
        } else {
            difference
        }
    };
    Some(if distance(&convergent) <= distance(&intermediate) {
        convergent
    } else {
        intermediate
    })
}

/// The last two convergents of a continued fraction that is being read term by term.
struct Convergents {
    numerators: [Integer; 2],
    denominators: [Integer; 2],
}

impl Convergents {
    fn new() -> Self {
        Convergents {
            numerators: [Integer::ZERO, Integer::ONE],
            denominators: [Integer::ONE, Integer::ZERO],
        }
    }

    fn denominator_after(&self, term: &Integer) -> Integer {
        &self.denominators[0] + term * &self.denominators[1]
    }

    fn push(&mut self, term: &Integer) {
        let numerator = &self.numerators[0] + term * &self.numerators[1];
        let denominator = self.denominator_after(term);
        self.numerators.swap(0, 1);
        self.denominators.swap(0, 1);
        self.numerators[1] = numerator;
        self.denominators[1] = denominator;
    }

    /// The fraction of all terms so far, at least one; convergents are reduced by their construction.
    fn last(&self) -> Rational {
        Rational::new_raw(self.numerators[1].clone(), self.denominators[1].clone())
    }
}
