//! Integers beyond 64 bits by `num-bigint`: the default backend, in Rust alone.

use std::cmp::Ordering;

use num_bigint::{BigInt, Sign};
use num_integer::Integer as _;
use num_traits::ToPrimitive as _;

/// An integer of any size.
pub(super) type Backend = BigInt;

pub(super) fn from_i128(value: i128) -> Backend {
    BigInt::from(value)
}

pub(super) fn from_u128(value: u128) -> Backend {
    BigInt::from(value)
}

pub(super) fn to_i64(a: &Backend) -> Option<i64> {
    a.to_i64()
}

pub(super) fn to_u64(a: &Backend) -> Option<u64> {
    a.to_u64()
}

pub(super) fn to_i128(a: &Backend) -> Option<i128> {
    a.to_i128()
}

pub(super) fn add(a: &Backend, b: &Backend) -> Backend {
    a + b
}

pub(super) fn sub(a: &Backend, b: &Backend) -> Backend {
    a - b
}

pub(super) fn mul(a: &Backend, b: &Backend) -> Backend {
    a * b
}

pub(super) fn add_assign(a: &mut Backend, b: &Backend) {
    *a += b;
}

pub(super) fn sub_assign(a: &mut Backend, b: &Backend) {
    *a -= b;
}

pub(super) fn mul_assign(a: &mut Backend, b: &Backend) {
    *a *= b;
}

pub(super) fn add_small(a: &mut Backend, b: i64) {
    *a += b;
}

pub(super) fn sub_small(a: &mut Backend, b: i64) {
    *a -= b;
}

pub(super) fn mul_small(a: &mut Backend, b: i64) {
    *a *= b;
}

/// Quotient towards zero and remainder with the sign of `a`; `b` is not zero.
pub(super) fn div_rem(a: &Backend, b: &Backend) -> (Backend, Backend) {
    a.div_rem(b)
}

pub(super) fn div(a: &Backend, b: &Backend) -> Backend {
    a / b
}

pub(super) fn rem(a: &Backend, b: &Backend) -> Backend {
    a % b
}

/// Quotient when the remainder is known to be zero.
pub(super) fn div_exact(a: &Backend, b: &Backend) -> Backend {
    a / b
}

/// |a| mod b, for b > 0.
pub(super) fn magnitude_rem(a: &Backend, b: u64) -> u64 {
    (a.magnitude() % b).to_u64().expect("a remainder by a u64 is a u64")
}

pub(super) fn gcd(a: &Backend, b: &Backend) -> Backend {
    a.gcd(b)
}

pub(super) fn neg(a: Backend) -> Backend {
    -a
}

pub(super) fn shl(a: &Backend, bits: u32) -> Backend {
    a << bits
}

/// Floor of a / 2^bits.
pub(super) fn shr(a: &Backend, bits: u32) -> Backend {
    a >> bits
}

pub(super) fn pow(a: &Backend, exponent: u32) -> Backend {
    a.pow(exponent)
}

/// Floor of √a, for a ≥ 0.
pub(super) fn sqrt(a: &Backend) -> Backend {
    a.sqrt()
}

/// Bit length of |a|.
pub(super) fn bits(a: &Backend) -> u64 {
    a.bits()
}

/// Exponent of the largest power of two that divides `a`, for a ≠ 0.
pub(super) fn trailing_zeros(a: &Backend) -> u64 {
    a.trailing_zeros().unwrap_or(0)
}

pub(super) fn sign(a: &Backend) -> Ordering {
    match a.sign() {
        Sign::Minus => Ordering::Less,
        Sign::NoSign => Ordering::Equal,
        Sign::Plus => Ordering::Greater,
    }
}

/// The leading 64 bits of |a|, for |a| ≥ 2^63.
pub(super) fn leading_64(a: &Backend) -> u64 {
    let mut digits = a.iter_u64_digits().rev();
    let high = digits.next().unwrap_or(0);
    let low = digits.next().unwrap_or(0);
    match high.leading_zeros() {
        0 => high,
        zeros => (high << zeros) | (low >> (64 - zeros)),
    }
}

/// `text` is an optional '-' and decimal digits.
pub(super) fn parse(text: &str) -> Option<Backend> {
    text.parse().ok()
}

pub(super) fn magnitude_bytes_le(a: &Backend) -> Vec<u8> {
    a.magnitude().to_bytes_le()
}

pub(super) fn from_magnitude_bytes_le(bytes: &[u8]) -> Backend {
    BigInt::from_bytes_le(Sign::Plus, bytes)
}
