//! Double-double arithmetic: a number as the unevaluated sum of two binary64 numbers, about 106 bits (Dekker 1971; Hida, Li, Bailey 2001).
//!
//! One operation has a relative error of at most 2^-100, as long as nothing leaves the range from 2^-450 to 2^450.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// high + low, with |low| at most half a unit in the last place of `high`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Double {
    high: f64,
    low: f64,
}

/// a + b and its rounding error (Knuth 1969).
#[inline(always)]
pub(super) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

/// The same for |a| ≥ |b| (Dekker 1971).
#[inline(always)]
fn quick_two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    (sum, b - (sum - a))
}

/// A number as the sum of two with 26 bits each (Veltkamp 1968).
#[inline(always)]
fn halves(a: f64) -> (f64, f64) {
    let shifted = 134_217_729.0 * a;
    let high = shifted - (shifted - a);
    (high, a - high)
}

/// a·b and its rounding error.
#[inline(always)]
pub(super) fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    if cfg!(target_feature = "fma") {
        return (product, a.mul_add(b, -product));
    }
    // Without the instruction, `mul_add` is a call; Dekker's product is faster.
    let ((a1, a2), (b1, b2)) = (halves(a), halves(b));
    (product, ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2)
}

impl Double {
    /// Zero.
    pub(super) const ZERO: Double = Double { high: 0.0, low: 0.0 };
    /// One.
    pub(super) const ONE: Double = Double { high: 1.0, low: 0.0 };

    /// a − b, exactly.
    #[inline(always)]
    pub(super) fn difference(a: f64, b: f64) -> Double {
        let (high, low) = two_sum(a, -b);
        Double { high, low }
    }

    /// a·b, exactly.
    #[inline(always)]
    pub(super) fn product(a: f64, b: f64) -> Double {
        let (high, low) = two_product(a, b);
        Double { high, low }
    }

    /// The nearest binary64 number.
    #[inline(always)]
    pub(super) fn value(self) -> f64 {
        self.high
    }

    /// What is left beyond the nearest binary64 number.
    #[inline(always)]
    pub(super) fn rest(self) -> f64 {
        self.low
    }

    /// This times a binary64 number.
    #[inline(always)]
    pub(super) fn times(self, factor: f64) -> Double {
        let (product, error) = two_product(self.high, factor);
        let (high, low) = quick_two_sum(product, error + self.low * factor);
        Double { high, low }
    }

    /// The square root of a number that is not negative; 0 for a negative one.
    pub(super) fn sqrt(self) -> Double {
        if self.high <= 0.0 {
            return Double::ZERO;
        }
        // One Newton step (Karp and Markstein 1997).
        let root = self.high.sqrt();
        let rest = self - Double::product(root, root);
        let (high, low) = quick_two_sum(root, rest.high / (2.0 * root));
        Double { high, low }
    }
}

impl From<f64> for Double {
    #[inline(always)]
    fn from(value: f64) -> Double {
        Double { high: value, low: 0.0 }
    }
}

impl Neg for Double {
    type Output = Double;
    #[inline(always)]
    fn neg(self) -> Double {
        Double {
            high: -self.high,
            low: -self.low,
        }
    }
}

impl Add for Double {
    type Output = Double;
    #[inline(always)]
    fn add(self, other: Double) -> Double {
        let (sum, error) = two_sum(self.high, other.high);
        let (low_sum, low_error) = two_sum(self.low, other.low);
        let (sum, error) = quick_two_sum(sum, error + low_sum);
        let (high, low) = quick_two_sum(sum, error + low_error);
        Double { high, low }
    }
}

impl Sub for Double {
    type Output = Double;
    #[inline(always)]
    fn sub(self, other: Double) -> Double {
        self + -other
    }
}

impl Mul for Double {
    type Output = Double;
    #[inline(always)]
    fn mul(self, other: Double) -> Double {
        let (product, error) = two_product(self.high, other.high);
        let cross = self.high * other.low + self.low * other.high;
        let (high, low) = quick_two_sum(product, error + cross);
        Double { high, low }
    }
}

impl Div for Double {
    type Output = Double;
    #[inline(always)]
    fn div(self, other: Double) -> Double {
        // Two steps suffice for 2^-102 (Joldes, Muller and Popescu 2017, algorithm 17).
        let first = self.high / other.high;
        let product = other.times(first);
        let rest = (self.high - product.high) + (self.low - product.low);
        let (high, low) = quick_two_sum(first, rest / other.high);
        Double { high, low }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::{Rational, RationalExt};
    use num_traits::Signed;
    use proptest::prelude::*;

    fn exact(x: Double) -> Rational {
        Rational::from_f64(x.high).unwrap() + Rational::from_f64(x.low).unwrap()
    }

    fn close(found: Double, expected: &Rational) {
        let error = (exact(found) - expected).abs().to_f64();
        assert!(error <= 2f64.powi(-100) * expected.abs().to_f64(), "{found:?} {error}");
        assert_eq!(found.value(), found.high + found.low);
    }

    fn numbers() -> impl Strategy<Value = Double> {
        (-1e9..1e9f64, -1.0..1.0f64, -60..60i32).prop_map(|(a, b, e)| {
            let (a, b) = (a * 2f64.powi(e), b * 2f64.powi(e - 50));
            let (high, low) = two_sum(a, b);
            Double { high, low }
        })
    }

    proptest! {
        #[test]
        fn operations_have_a_hundred_bits(a in numbers(), b in numbers()) {
            let (x, y) = (exact(a), exact(b));
            close(a + b, &(&x + &y));
            close(a - b, &(&x - &y));
            close(a * b, &(&x * &y));
            close(a.times(b.high), &(&x * Rational::from_f64(b.high).unwrap()));
            if b.high != 0.0 {
                close(a / b, &(&x / &y));
            }
            let square = a * a;
            close(square.sqrt() * square.sqrt(), &exact(square));
        }

        #[test]
        fn differences_and_products_are_exact(a in -1e12..1e12f64, b in -1e-3..1e-3f64) {
            let (x, y) = (Rational::from_f64(a).unwrap(), Rational::from_f64(b).unwrap());
            prop_assert_eq!(exact(Double::difference(a, b)), &x - &y);
            prop_assert_eq!(exact(Double::product(a, b)), x * y);
        }
    }
}
