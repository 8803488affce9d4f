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
        simplest_between_positive(lower, upper)
    } else if upper.numer().is_negative() {
        -simplest_between_positive(&-upper, &-lower)
    } else {
        Rational::from_integer(Integer::ZERO)
    }
}

/// The same for 0 < lower ≤ upper, by the continued fraction that the two ends have in common.
fn simplest_between_positive(lower: &Rational, upper: &Rational) -> Rational {
    let mut convergents = Convergents::new();
    // The ends as pairs of integers, which need no reduction.
    let (mut p, mut q) = (lower.numer().clone(), lower.denom().clone());
    let (mut r, mut s) = (upper.numer().clone(), upper.denom().clone());
    loop {
        let whole = p.div_ceil(&q);
        if &whole * &s <= r {
            convergents.push(&whole);
            return convergents.last();
        }
        // No integer between the ends: both lie strictly between two consecutive ones.
        let floor = whole - Integer::ONE;
        convergents.push(&floor);
        // The ends of what is left, 1/(r/s − floor) and 1/(p/q − floor).
        let (from_upper, from_lower) = (r - &floor * &s, p - &floor * &q);
        (p, q, r, s) = (s, from_upper, q, from_lower);
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

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::number::generate::rationals;

    fn fraction(numerator: i64, denominator: i64) -> Rational {
        Rational::new(Integer::from(numerator), Integer::from(denominator))
    }

    #[test]
    fn known_values() {
        let simplest =
            |a: (i64, i64), b: (i64, i64)| simplest_between(&fraction(a.0, a.1), &fraction(b.0, b.1)).format();
        assert_eq!(simplest((314, 100), (315, 100)), "22/7");
        assert_eq!(simplest((-315, 100), (-314, 100)), "-22/7");
        assert_eq!(simplest((-1, 3), (5, 1)), "0");
        assert_eq!(simplest((5, 2), (17, 2)), "3");
        assert_eq!(simplest((-17, 2), (-5, 2)), "-3");
        assert_eq!(simplest((7, 5), (7, 5)), "7/5");
        assert_eq!(simplest((0, 1), (1, 9)), "0");
        assert_eq!(simplest((1, 1000), (1, 999)), "1/999");
        let pi = |limit| approximate(std::f64::consts::PI, limit).unwrap().format();
        assert_eq!(
            [pi(1), pi(6), pi(7), pi(105), pi(106), pi(112), pi(113)],
            ["3", "19/6", "22/7", "311/99", "333/106", "333/106", "355/113"]
        );
        assert_eq!(approximate(0.5, u64::MAX), Some(fraction(1, 2)));
        assert_eq!(approximate(-0.1, 1000), Some(fraction(-1, 10)));
        // Equally near to 0 and to 1.
        assert_eq!(approximate(0.5, 1).unwrap().denom(), &Integer::ONE);
        assert_eq!(approximate(1.0, 0), None);
        assert_eq!(approximate(0.3, 0), None);
        assert_eq!(approximate(f64::NAN, 5), None);
        assert_eq!(approximate(f64::INFINITY, 5), None);
        assert_eq!(approximate(5e-324, 1_000_000).unwrap().format(), "0");
        assert_eq!(approximate(f64::MAX, 1), Rational::from_f64(f64::MAX));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]

        #[test]
        fn simplest_by_trial(a in -3000_i64..3000, b in 1_i64..400, c in -3000_i64..3000, d in 1_i64..400) {
            let (x, y) = (fraction(a, b), fraction(c, d));
            let found = simplest_between(&x, &y);
            let (lower, upper) = if x <= y { (x, y) } else { (y, x) };
            let denominator = (1_i64..).find(|&denominator| {
                let denominator = Integer::from(denominator);
                (lower.numer() * &denominator).div_ceil(lower.denom()) <= (upper.numer() * &denominator).div_floor(upper.denom())
            });
            prop_assert_eq!(found.denom(), &Integer::from(denominator.unwrap()));
            prop_assert!(lower <= found && found <= upper);
            if found.is_integer() {
                // One step towards zero leaves the interval.
                let step = Rational::from_integer(Integer::from(found.numer().sign() as i64));
                let nearer = &found - &step;
                prop_assert!(found.numer().is_zero() || nearer < lower || nearer > upper);
            }
        }

        #[test]
        fn simplest_of_long_intervals(x in rationals(), bits in 0_u32..300) {
            let width = Rational::new(Integer::ONE, Integer::ONE << bits);
            let upper = &x + &width;
            let found = simplest_between(&x, &upper);
            prop_assert!(x <= found && found <= upper);
            prop_assert!(found.denom() <= x.denom());
            prop_assert!(found.denom() <= &(Integer::ONE << bits));
            prop_assert_eq!(simplest_between(&x, &x), x);
        }

        #[test]
        fn nearest_by_trial(x in -50.0..50.0_f64, limit in 1_u64..80) {
            let exact = Rational::from_f64(x).unwrap();
            let distance = |candidate: &Rational| {
                let difference = candidate - &exact;
                if difference.numer().is_negative() { -difference } else { difference }
            };
            let found = approximate(x, limit).unwrap();
            prop_assert!(found.denom() <= &Integer::from(limit));
            let least = (1..=limit)
                .flat_map(|denominator| {
                    let denominator = Integer::from(denominator);
                    let floor = (exact.numer() * &denominator).div_floor(exact.denom());
                    let ceiling = &floor + Integer::ONE;
                    [Rational::new(floor, denominator.clone()), Rational::new(ceiling, denominator)]
                })
                .map(|candidate| distance(&candidate))
                .min();
            prop_assert_eq!(Some(distance(&found)), least);
        }
    }
}
