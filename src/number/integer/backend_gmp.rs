//! Integers beyond 64 bits by GMP, through `rug`: feature `gmp`.

use std::cmp::Ordering;

use rug::integer::Order;
use rug::ops::Pow as _;
use rug::{Complete as _, Integer};

/// An integer of any size.
pub(super) type Backend = Integer;

pub(super) fn from_i128(value: i128) -> Backend {
    Integer::from(value)
}

pub(super) fn from_u128(value: u128) -> Backend {
    Integer::from(value)
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
    (a + b).complete()
}

pub(super) fn sub(a: &Backend, b: &Backend) -> Backend {
    (a - b).complete()
}

pub(super) fn mul(a: &Backend, b: &Backend) -> Backend {
    (a * b).complete()
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
    a.div_rem_ref(b).complete()
}

pub(super) fn div(a: &Backend, b: &Backend) -> Backend {
    (a / b).complete()
}

pub(super) fn rem(a: &Backend, b: &Backend) -> Backend {
    (a % b).complete()
}

/// Quotient when the remainder is known to be zero.
pub(super) fn div_exact(a: &Backend, b: &Backend) -> Backend {
    a.div_exact_ref(b).complete()
}

/// |a| mod b, for b > 0.
pub(super) fn magnitude_rem(a: &Backend, b: u64) -> u64 {
    let remainder: Backend = (a % b).complete();
    remainder.abs().to_u64().expect("a remainder by a u64 is a u64")
}

pub(super) fn gcd(a: &Backend, b: &Backend) -> Backend {
    a.gcd_ref(b).complete()
}

pub(super) fn neg(a: Backend) -> Backend {
    -a
}

pub(super) fn shl(a: &Backend, bits: u32) -> Backend {
    (a << bits).complete()
}

/// Floor of a / 2^bits.
pub(super) fn shr(a: &Backend, bits: u32) -> Backend {
    (a >> bits).complete()
}

pub(super) fn pow(a: &Backend, exponent: u32) -> Backend {
    a.pow(exponent).complete()
}

/// Floor of √a, for a ≥ 0.
pub(super) fn sqrt(a: &Backend) -> Backend {
    a.sqrt_ref().complete()
}

/// Bit length of |a|.
pub(super) fn bits(a: &Backend) -> u64 {
    u64::from(a.significant_bits())
}

/// Exponent of the largest power of two that divides `a`, for a ≠ 0.
pub(super) fn trailing_zeros(a: &Backend) -> u64 {
    a.find_one(0).map_or(0, u64::from)
}

pub(super) fn sign(a: &Backend) -> Ordering {
    a.cmp0()
}

/// The leading 64 bits of |a|, for |a| ≥ 2^63.
pub(super) fn leading_64(a: &Backend) -> u64 {
    (&*a.as_abs() >> (a.significant_bits() - 64))
        .complete()
        .to_u64_wrapping()
}

/// `text` is an optional '-' and decimal digits.
pub(super) fn parse(text: &str) -> Option<Backend> {
    text.parse().ok()
}

pub(super) fn magnitude_bytes_le(a: &Backend) -> Vec<u8> {
    a.to_digits::<u8>(Order::Lsf)
}

pub(super) fn from_magnitude_bytes_le(bytes: &[u8]) -> Backend {
    Integer::from_digits(bytes, Order::Lsf)
}
