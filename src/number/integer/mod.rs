//! Exact integers of any size, fast while they fit in 64 bits.

mod arithmetic;
mod convert;
mod division;
mod float;
mod traits;

#[cfg(not(feature = "gmp"))]
#[path = "backend_num.rs"]
mod backend;
#[cfg(feature = "gmp")]
#[path = "backend_gmp.rs"]
mod backend;

#[cfg(test)]
mod tests;

use std::cmp::Ordering;

use backend::Backend;
pub(crate) use float::{round_scaled, with_sign};

/// An exact integer of any size.
///
/// Values that fit in `i64` are held inline, and arithmetic on them is machine arithmetic with an overflow check; all
/// others live in the backend: `num-bigint`, or GMP with feature `gmp`. The representation of a value is unique, so
/// equality and hashing are those of the value.
///
/// Division by zero panics, as it does for the primitive integers.
///
/// ```
/// use knotproof::number::Integer;
/// let large = Integer::from(i64::MAX) * Integer::from(3);
/// assert_eq!(large.to_string(), "27670116110564327421");
/// assert_eq!(large / Integer::from(3), Integer::from(i64::MAX));
/// ```
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct Integer(Repr);

/// `Large` only for values outside the range of `i64`.
#[derive(Clone, PartialEq, Eq, Hash)]
enum Repr {
    Small(i64),
    Large(Backend),
}

use Repr::{Large, Small};

impl Integer {
    /// The number 0.
    pub const ZERO: Integer = Integer(Small(0));
    /// The number 1.
    pub const ONE: Integer = Integer(Small(1));

    const fn small(value: i64) -> Self {
        Integer(Small(value))
    }

    fn wide(value: i128) -> Self {
        match i64::try_from(value) {
            Ok(value) => Integer(Small(value)),
            Err(_) => Integer(Large(backend::from_i128(value))),
        }
    }

    fn from_backend(value: Backend) -> Self {
        match backend::to_i64(&value) {
            Some(value) => Integer(Small(value)),
            None => Integer(Large(value)),
        }
    }

    /// Restores the unique representation after an operation in place.
    fn shrink(&mut self) {
        if let Large(value) = &self.0
            && let Some(value) = backend::to_i64(value)
        {
            self.0 = Small(value);
        }
    }

    /// The value, to be changed in place, when it fits in 64 bits.
    pub(crate) fn small_mut(&mut self) -> Option<&mut i64> {
        match &mut self.0 {
            Small(value) => Some(value),
            Large(_) => None,
        }
    }

    /// The value in the backend's representation, whatever its size.
    fn to_backend(&self) -> Backend {
        match &self.0 {
            Small(value) => backend::from_i128(i128::from(*value)),
            Large(value) => value.clone(),
        }
    }

    /// The sign: the comparison of `self` with zero.
    #[inline]
    pub fn sign(&self) -> Ordering {
        match &self.0 {
            Small(value) => value.cmp(&0),
            Large(value) => backend::sign(value),
        }
    }

    /// Whether the value is 0.
    #[inline]
    pub fn is_zero(&self) -> bool {
        matches!(self.0, Small(0))
    }

    /// Whether the value is 1.
    #[inline]
    pub fn is_one(&self) -> bool {
        matches!(self.0, Small(1))
    }

    /// Whether the value is less than 0.
    #[inline]
    pub fn is_negative(&self) -> bool {
        self.sign() == Ordering::Less
    }

    /// Whether the value is greater than 0.
    #[inline]
    pub fn is_positive(&self) -> bool {
        self.sign() == Ordering::Greater
    }

    /// The absolute value.
    pub fn abs(&self) -> Integer {
        if self.is_negative() { -self } else { self.clone() }
    }

    /// Bit length of the magnitude: the least k with |self| < 2^k, so 0 for 0.
    #[inline]
    pub fn bits(&self) -> u64 {
        match &self.0 {
            Small(value) => u64::from(64 - value.unsigned_abs().leading_zeros()),
            Large(value) => backend::bits(value),
        }
    }

    /// Exponent of the largest power of two that divides the value; `None` for 0.
    #[inline]
    pub fn trailing_zeros(&self) -> Option<u64> {
        match &self.0 {
            Small(0) => None,
            Small(value) => Some(u64::from(value.trailing_zeros())),
            Large(value) => Some(backend::trailing_zeros(value)),
        }
    }

    /// Whether the value is 2^k for some k ≥ 0.
    pub fn is_power_of_two(&self) -> bool {
        self.is_positive() && self.trailing_zeros() == Some(self.bits() - 1)
    }

    /// `self` to the power `exponent`, with 0⁰ = 1.
    pub fn pow(&self, exponent: u32) -> Integer {
        match &self.0 {
            Small(base) => match base.checked_pow(exponent) {
                Some(power) => Integer::small(power),
                None => Integer::from_backend(backend::pow(&self.to_backend(), exponent)),
            },
            Large(base) => Integer::from_backend(backend::pow(base, exponent)),
        }
    }

    /// ⌊√self⌋; `None` for a negative number.
    pub fn sqrt_floor(&self) -> Option<Integer> {
        if self.is_negative() {
            return None;
        }
        Some(match &self.0 {
            Small(value) => Integer::small(value.isqrt()),
            Large(value) => Integer::from_backend(backend::sqrt(value)),
        })
    }

    /// The number of ways to choose `k` of `n` things; 0 for k > n.
    pub fn binomial(n: u32, k: u32) -> Integer {
        if k > n {
            return Integer::ZERO;
        }
        let mut product = Integer::ONE;
        // After step i the product is C(n, i + 1), so every division is exact.
        for i in 0..k.min(n - k) {
            product *= Integer::from(n - i);
            product = product.div_exact(&Integer::from(i + 1));
        }
        product
    }
}

impl Default for Integer {
    /// Zero.
    fn default() -> Self {
        Integer::ZERO
    }
}

impl PartialOrd for Integer {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Integer {
    #[inline]
    fn cmp(&self, other: &Self) -> Ordering {
        match (&self.0, &other.0) {
            (Small(a), Small(b)) => a.cmp(b),
            (Large(a), Large(b)) => a.cmp(b),
            // A large value lies outside the range of all small ones.
            (Large(a), Small(_)) => backend::sign(a),
            (Small(_), Large(b)) => backend::sign(b).reverse(),
        }
    }
}
