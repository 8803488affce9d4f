//! Division in its several roundings, and divisors.

use std::ops::{Div, DivAssign, Rem, RemAssign};

use num_integer::Integer as _;

use super::arithmetic::operator;
use super::{Integer, Large, Small, backend};

impl Integer {
    /// Quotient rounded towards zero, and remainder with the sign of `self`: self = quotient · divisor + remainder.
    ///
    /// # Panics
    /// When `divisor` is 0.
    pub fn div_rem(&self, divisor: &Integer) -> (Integer, Integer) {
        refuse_zero(divisor);
        match (&self.0, &divisor.0) {
            (Small(a), Small(b)) => (quotient_of_small(*a, *b), Integer::small(a.wrapping_rem(*b))),
            (Large(a), Large(b)) => pair(backend::div_rem(a, b)),
            _ => pair(backend::div_rem(&self.to_backend(), &divisor.to_backend())),
        }
    }

    #[inline]
    fn div_borrowed(&self, divisor: &Integer) -> Integer {
        refuse_zero(divisor);
        match (&self.0, &divisor.0) {
            (Small(a), Small(b)) => quotient_of_small(*a, *b),
            (Large(a), Large(b)) => Integer::from_backend(backend::div(a, b)),
            _ => Integer::from_backend(backend::div(&self.to_backend(), &divisor.to_backend())),
        }
    }

    #[inline]
    fn rem_borrowed(&self, divisor: &Integer) -> Integer {
        refuse_zero(divisor);
        match (&self.0, &divisor.0) {
            (Small(a), Small(b)) => Integer::small(a.wrapping_rem(*b)),
            (Large(a), Large(b)) => Integer::from_backend(backend::rem(a, b)),
            _ => Integer::from_backend(backend::rem(&self.to_backend(), &divisor.to_backend())),
        }
    }

    #[inline]
    fn div_in_place(&mut self, divisor: &Integer) {
        *self = self.div_borrowed(divisor);
    }

    #[inline]
    fn rem_in_place(&mut self, divisor: &Integer) {
        *self = self.rem_borrowed(divisor);
    }

    /// ⌊self / divisor⌋.
    ///
    /// # Panics
    /// When `divisor` is 0.
    pub fn div_floor(&self, divisor: &Integer) -> Integer {
        let (quotient, remainder) = self.div_rem(divisor);
        if !remainder.is_zero() && remainder.is_negative() != divisor.is_negative() {
            quotient - Integer::ONE
        } else {
            quotient
        }
    }

    /// ⌈self / divisor⌉.
    ///
    /// # Panics
    /// When `divisor` is 0.
    pub fn div_ceil(&self, divisor: &Integer) -> Integer {
        let (quotient, remainder) = self.div_rem(divisor);
        if !remainder.is_zero() && remainder.is_negative() == divisor.is_negative() {
            quotient + Integer::ONE
        } else {
            quotient
        }
    }

    /// self / divisor, where the division is known to leave no remainder; otherwise the result means nothing.
    ///
    /// # Panics
    /// When `divisor` is 0.
    #[inline]
    pub fn div_exact(&self, divisor: &Integer) -> Integer {
        refuse_zero(divisor);
        match (&self.0, &divisor.0) {
            (Small(a), Small(b)) => quotient_of_small(*a, *b),
            (Large(a), Large(b)) => Integer::from_backend(backend::div_exact(a, b)),
            (Large(a), Small(_)) => Integer::from_backend(backend::div_exact(a, &divisor.to_backend())),
            // Only -2^63 / 2^63 and 0 / divisor leave no remainder here.
            (Small(_), Large(_)) => self.div_borrowed(divisor),
        }
    }

    /// The greatest common divisor, never negative; that of 0 and 0 is 0.
    pub fn gcd(&self, other: &Integer) -> Integer {
        match (&self.0, &other.0) {
            (Small(a), Small(b)) => Integer::from(a.unsigned_abs().gcd(&b.unsigned_abs())),
            (Large(a), Large(b)) => Integer::from_backend(backend::gcd(a, b)),
            (Small(0), Large(_)) => other.abs(),
            (Large(_), Small(0)) => self.abs(),
            (Small(small), Large(large)) | (Large(large), Small(small)) => {
                let small = small.unsigned_abs();
                Integer::from(backend::magnitude_rem(large, small).gcd(&small))
            }
        }
    }

    /// The least common multiple, never negative; 0 when either number is 0.
    pub fn lcm(&self, other: &Integer) -> Integer {
        if self.is_zero() || other.is_zero() {
            return Integer::ZERO;
        }
        (self.div_exact(&self.gcd(other)) * other).abs()
    }
}

#[inline]
fn refuse_zero(divisor: &Integer) {
    assert!(!divisor.is_zero(), "division by zero");
}

#[inline]
fn quotient_of_small(a: i64, b: i64) -> Integer {
    match a.checked_div(b) {
        Some(quotient) => Integer::small(quotient),
        None => Integer::wide(i128::from(a) / i128::from(b)),
    }
}

fn pair((quotient, remainder): (backend::Backend, backend::Backend)) -> (Integer, Integer) {
    (Integer::from_backend(quotient), Integer::from_backend(remainder))
}

operator!(Div div, DivAssign div_assign, div_borrowed, div_in_place, |a, b| a.div_borrowed(&b));
operator!(Rem rem, RemAssign rem_assign, rem_borrowed, rem_in_place, |a, b| a.rem_borrowed(&b));
