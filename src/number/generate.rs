//! Numbers for the tests: small ones, ones on both sides of the 64-bit limits, and long ones.

use proptest::prelude::*;

use super::{Integer, Rational};

/// Integers of every size, with the edges of the 64-bit range frequent.
pub fn integers() -> impl Strategy<Value = Integer> {
    prop_oneof![
        (-20_i64..20).prop_map(Integer::from),
        any::<i64>().prop_map(Integer::from),
        near_limits().prop_map(Integer::from),
        any::<i128>().prop_map(Integer::from),
        (any::<bool>(), prop::collection::vec(any::<u8>(), 0..60))
            .prop_map(|(negative, bytes)| Integer::from_magnitude_bytes_le(negative, &bytes)),
    ]
}

/// Values at most 3 away from 0, ±2^31, ±2^32, ±2^53, ±2^62, ±2^63, ±2^64 and ±2^65.
pub fn near_limits() -> impl Strategy<Value = i128> {
    let bits = prop::sample::select(vec![31_u32, 32, 53, 62, 63, 63, 63, 64, 65]);
    (bits, -1_i128..=1, -3_i128..=3).prop_map(|(bits, sign, offset)| sign * (1 << bits) + offset)
}

/// Fractions of every size, integers and powers of two in the denominator included.
pub fn rationals() -> impl Strategy<Value = Rational> {
    let denominator = prop_oneof![
        Just(Integer::ONE),
        (1_i64..50).prop_map(Integer::from),
        (0_u32..100).prop_map(|bits| Integer::ONE << bits),
        integers().prop_map(|integer| if integer.is_zero() { Integer::ONE } else { integer }),
    ];
    (integers(), denominator).prop_map(|(numerator, denominator)| Rational::new(numerator, denominator))
}

/// Fractions above zero.
pub fn positive_rationals() -> impl Strategy<Value = Rational> {
    rationals().prop_map(|x| {
        if x.numer().is_zero() {
            Rational::from_integer(Integer::ONE)
        } else {
            Rational::new_raw(x.numer().abs(), x.denom().clone())
        }
    })
}

/// Finite binary64 numbers of every exponent.
pub fn finite() -> impl Strategy<Value = f64> {
    any::<u64>()
        .prop_map(f64::from_bits)
        .prop_filter("finite", |value| value.is_finite())
}
