//! Against `num-bigint`, which knows nothing of the 64-bit fast path, and against closed formulas.

use std::cmp::Ordering;
use std::collections::HashSet;

use num_bigint::{BigInt, BigUint};
use num_integer::Integer as _;
use num_traits::{Num as _, Signed as _};
use proptest::prelude::*;

use super::*;
use crate::number::NumberError;
use crate::number::generate::{integers, near_limits};

fn reference(value: &Integer) -> BigInt {
    value.to_string().parse().unwrap()
}

/// The value is the expected one, in its unique representation.
fn agree(value: &Integer, expected: &BigInt) {
    assert_eq!(value.to_string(), expected.to_string());
    assert_eq!(matches!(value.0, Small(_)), i64::try_from(expected).is_ok());
}

/// Every operation on a pair, in all its forms.
fn check_pair(a: &Integer, b: &Integer) {
    let (x, y) = (reference(a), reference(b));
    macro_rules! forms {
        ($operator:tt, $assign:tt) => {{
            let expected = &x $operator &y;
            agree(&(a $operator b), &expected);
            agree(&(a.clone() $operator b), &expected);
            agree(&(a $operator b.clone()), &expected);
            agree(&(a.clone() $operator b.clone()), &expected);
            let mut value = a.clone();
            value $assign b;
            agree(&value, &expected);
            let mut value = a.clone();
            value $assign b.clone();
            agree(&value, &expected);
        }};
    }
    forms!(+, +=);
    forms!(-, -=);
    forms!(*, *=);
    agree(&a.gcd(b), &x.gcd(&y));
    agree(&a.lcm(b), &x.lcm(&y));
    assert_eq!(a.cmp(b), x.cmp(&y));
    assert_eq!(a == b, x == y);
    agree(&a.abs_sub(b), &x.abs_sub(&y));
    if b.is_zero() {
        assert_eq!(a.is_multiple_of(b), a.is_zero());
        return;
    }
    forms!(/, /=);
    forms!(%, %=);
    agree(&a.div_floor(b), &x.div_floor(&y));
    agree(&a.div_ceil(b), &x.div_ceil(&y));
    agree(&a.mod_floor(b), &x.mod_floor(&y));
    agree(&(a * b).div_exact(b), &x);
    assert_eq!(a.is_multiple_of(b), x.is_multiple_of(&y));
    let (quotient, remainder) = a.div_rem(b);
    agree(&(quotient * b + remainder), &x);
}

fn check_single(a: &Integer, bits: u32) {
    let x = reference(a);
    agree(&-a, &-&x);
    agree(&-a.clone(), &-&x);
    agree(&a.abs(), &x.abs());
    agree(&a.signum(), &x.signum());
    agree(&(a << bits), &(&x << bits));
    agree(&(a.clone() << bits), &(&x << bits));
    // Floor by its definition, not by the other shift.
    let floor = x.div_floor(&(BigInt::from(1) << bits));
    agree(&(a >> bits), &floor);
    let mut shifted = a.clone();
    shifted >>= bits;
    agree(&shifted, &floor);
    shifted <<= bits;
    agree(&shifted, &(floor << bits));
    assert_eq!(a.bits(), x.bits());
    assert_eq!(a.trailing_zeros(), x.trailing_zeros());
    assert_eq!(a.sign(), x.cmp(&BigInt::from(0)));
    assert_eq!(a.is_even(), x.is_even());
    assert_eq!(a.is_odd(), x.is_odd());
    assert_eq!(
        a.is_power_of_two(),
        x > BigInt::from(0) && x.magnitude().count_ones() == 1
    );
    assert_eq!(a.to_i64(), i64::try_from(&x).ok());
    assert_eq!(a.to_u64(), u64::try_from(&x).ok());
    assert_eq!(a.to_i128(), i128::try_from(&x).ok());
    let bytes = a.magnitude_bytes_le();
    assert_ne!(bytes.last(), Some(&0));
    assert_eq!(&BigUint::from_bytes_le(&bytes), x.magnitude());
    assert_eq!(&Integer::from_magnitude_bytes_le(a.is_negative(), &bytes), a);
    assert_eq!(a.to_string().parse::<Integer>().as_ref(), Ok(a));
    assert_eq!(Integer::from_str_radix(&x.to_str_radix(16), 16).as_ref(), Ok(a));
    // The standard library's parser rounds correctly.
    assert_eq!(a.to_f64(), a.to_string().parse::<f64>().unwrap());
    let root = a.abs().sqrt_floor().unwrap();
    assert!(&root * &root <= a.abs());
    assert!((&root + Integer::ONE).pow(2) > a.abs());
    assert_eq!(a.sqrt_floor().is_none(), a.is_negative());
}

#[test]
fn every_pair_at_the_limits() {
    let mut values: Vec<Integer> = Vec::new();
    for bits in [0_u32, 1, 31, 32, 62, 63, 64, 126] {
        for offset in -1..=1_i128 {
            for sign in [-1, 1] {
                values.push(Integer::from(sign * (1_i128 << bits) + offset));
            }
        }
    }
    values.push(Integer::from(u128::MAX));
    values.push(-Integer::from(u128::MAX));
    for a in &values {
        check_single(a, 1);
        check_single(a, 63);
        for b in &values {
            check_pair(a, b);
        }
    }
}

#[test]
fn one_value_has_one_hash() {
    let beyond = Integer::from(i64::MAX) + Integer::ONE;
    let below = Integer::from(i64::MIN) - Integer::ONE;
    let maximum = &beyond - Integer::ONE;
    let minimum = &below + Integer::ONE;
    let set: HashSet<Integer> = [
        maximum,
        Integer::from(i64::MAX),
        minimum,
        Integer::from(i64::MIN),
        -&beyond,
        beyond.clone(),
        -(-&beyond),
        Integer::from(1_u64 << 63),
    ]
    .into();
    assert_eq!(set.len(), 3);
}

#[test]
fn primitives() {
    for (value, text) in [
        (Integer::from(i8::MIN), "-128"),
        (Integer::from(i16::MIN), "-32768"),
        (Integer::from(i32::MIN), "-2147483648"),
        (Integer::from(i64::MIN), "-9223372036854775808"),
        (Integer::from(i128::MIN), "-170141183460469231731687303715884105728"),
        (Integer::from(u8::MAX), "255"),
        (Integer::from(u16::MAX), "65535"),
        (Integer::from(u32::MAX), "4294967295"),
        (Integer::from(u64::MAX), "18446744073709551615"),
        (Integer::from(u128::MAX), "340282366920938463463374607431768211455"),
        (Integer::from(usize::MAX), &usize::MAX.to_string()),
        (Integer::default(), "0"),
    ] {
        assert_eq!(value.to_string(), text);
        assert_eq!(format!("{value:?}"), text);
    }
    assert_eq!(format!("{:>4}", Integer::from(-7)), "  -7");
}

#[test]
fn texts_refused() {
    assert_eq!("".parse::<Integer>(), Err(NumberError::Empty));
    for (text, position, found) in [
        ("-", 2, None),
        ("+1", 1, Some('+')),
        (" 1", 1, Some(' ')),
        ("12x", 3, Some('x')),
        ("--1", 2, Some('-')),
        ("1é", 2, Some('é')),
        ("123456789012345678901234567890_", 31, Some('_')),
    ] {
        let expected = NumberError::Unexpected {
            text: text.into(),
            position,
            found,
        };
        assert_eq!(text.parse::<Integer>(), Err(expected));
    }
    for text in ["-0", "00", "01", "-07", "00000000000000000000000000000000001"] {
        let error = text.parse::<Integer>();
        assert!(matches!(error, Err(NumberError::NotCanonical { .. })), "{text}");
    }
    assert!(Integer::from_str_radix("12", 2).is_err());
    assert!(Integer::from_str_radix("12", 99).is_err());
    assert!(Integer::from_str_radix("-", 16).is_err());
}

#[test]
fn bytes_with_zeros_at_the_end() {
    assert_eq!(Integer::from_magnitude_bytes_le(true, &[]), Integer::ZERO);
    assert_eq!(Integer::from_magnitude_bytes_le(true, &[0; 12]), Integer::ZERO);
    assert_eq!(
        Integer::from_magnitude_bytes_le(true, &[5, 0, 0, 0, 0, 0, 0, 0, 0, 0]),
        Integer::from(-5)
    );
    assert_eq!(
        Integer::from_magnitude_bytes_le(true, &[0, 0, 0, 0, 0, 0, 0, 128]),
        Integer::from(i64::MIN)
    );
    assert!(Integer::ZERO.magnitude_bytes_le().is_empty());
}

#[test]
fn binomials_make_pascals_triangle() {
    for n in 1..80 {
        for k in 0..=n + 1 {
            let sum = if k == 0 {
                Integer::ONE
            } else {
                Integer::binomial(n - 1, k - 1) + Integer::binomial(n - 1, k)
            };
            assert_eq!(Integer::binomial(n, k), sum);
        }
    }
    assert_eq!(Integer::binomial(0, 0), Integer::ONE);
    assert_eq!(Integer::binomial(u32::MAX, u32::MAX - 1), Integer::from(u32::MAX));
}

#[test]
fn rounding_to_binary64_at_the_edges() {
    let largest = Integer::from((1_i64 << 53) - 1) << 971;
    assert_eq!(largest.to_f64(), f64::MAX);
    // Halfway to 2^1024 rounds away, one less does not.
    let halfway = Integer::from((1_i64 << 54) - 1) << 970;
    assert_eq!(halfway.to_f64(), f64::INFINITY);
    assert_eq!((&halfway - Integer::ONE).to_f64(), f64::MAX);
    assert_eq!((-&halfway).to_f64(), f64::NEG_INFINITY);
    assert_eq!((Integer::ONE << 5000).to_f64(), f64::INFINITY);
    assert_eq!(Integer::ZERO.to_f64().to_bits(), 0);
    assert_eq!((Integer::ONE << 5000).to_f64_exponent(), (0.5, 5001));
    assert_eq!(((Integer::ONE << 5000) - Integer::ONE).to_f64_exponent(), (0.5, 5001));
    assert_eq!(Integer::ZERO.to_f64_exponent(), (0.0, 0));
    assert_eq!(Integer::from(i64::MIN).to_f64_exponent(), (-0.5, 64));
    // Ties, of 54 significant bits, with and without something below them.
    let tie = (Integer::ONE << 200) + (Integer::ONE << 147);
    assert_eq!(tie.to_f64(), 2_f64.powi(200));
    assert_eq!((&tie + Integer::ONE).to_f64(), (2_f64.powi(200)).next_up());
    assert_eq!((&tie - Integer::ONE).to_f64(), 2_f64.powi(200));
}

#[test]
fn round_scaled_reaches_every_range() {
    assert_eq!(round_scaled(1, -1074), f64::from_bits(1));
    assert_eq!(round_scaled(1, -1075), 0.0);
    assert_eq!(round_scaled(3, -1076), f64::from_bits(1));
    assert_eq!(round_scaled(3, -1075), f64::from_bits(2));
    assert_eq!(round_scaled(u64::MAX, -1138), f64::from_bits(1));
    assert_eq!(round_scaled(1 << 63, -1138), 0.0);
    assert_eq!(round_scaled((1 << 63) + 1, -1138), f64::from_bits(1));
    assert_eq!(round_scaled((1 << 53) - 1, -1075), f64::MIN_POSITIVE);
    assert_eq!(round_scaled(1, 1023), 2_f64.powi(1023));
    assert_eq!(round_scaled(1, 1024), f64::INFINITY);
    assert_eq!(round_scaled(1, i64::MAX), f64::INFINITY);
    assert_eq!(round_scaled(u64::MAX, i64::MIN), 0.0);
    assert_eq!(round_scaled(0, i64::MAX), 0.0);
}

#[test]
#[should_panic(expected = "division by zero")]
fn division_by_zero_panics() {
    let _ = Integer::ONE / Integer::ZERO;
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn pairs(a in integers(), b in integers()) {
        check_pair(&a, &b);
    }

    #[test]
    fn pairs_at_the_limits(a in near_limits(), b in near_limits()) {
        check_pair(&Integer::from(a), &Integer::from(b));
    }

    #[test]
    fn common_divisors(a in integers(), b in integers(), c in integers()) {
        check_pair(&(&a * &c), &(&b * &c));
    }

    #[test]
    fn singles(a in integers(), bits in 0_u32..200) {
        check_single(&a, bits);
    }

    #[test]
    fn powers(a in integers(), exponent in 0_u32..12) {
        agree(&a.pow(exponent), &reference(&a).pow(exponent));
    }

    #[test]
    fn squares_have_exact_roots(a in integers()) {
        let square = &a * &a;
        prop_assert_eq!(square.sqrt_floor(), Some(a.abs()));
        if !a.is_zero() {
            prop_assert_eq!((square - Integer::ONE).sqrt_floor(), Some(a.abs() - Integer::ONE));
        }
    }

    #[test]
    fn sums(values in prop::collection::vec(integers(), 0..8)) {
        let expected: BigInt = values.iter().map(reference).sum();
        agree(&values.iter().sum(), &expected);
        agree(&values.into_iter().sum(), &expected);
    }

    #[test]
    fn mantissa_and_exponent(a in integers(), shift in 0_u32..3000) {
        let (mantissa, exponent) = a.to_f64_exponent();
        prop_assert_eq!(mantissa == 0.0, a.is_zero());
        if !a.is_zero() {
            prop_assert!((0.5..1.0).contains(&mantissa.abs()));
            // No value of the generator comes near the limits of binary64, so this product is exact.
            prop_assert_eq!(mantissa * 2_f64.powi(exponent as i32), a.to_f64());
            let shifted = (&a << shift).to_f64_exponent();
            prop_assert_eq!(shifted, (mantissa, exponent + i64::from(shift)));
        }
    }

    #[test]
    fn binary64_of_long_integers(a in integers(), bits in 0_u32..1100, b in integers()) {
        // A long gap of zeros exercises ties and the bits far below them.
        let value = (a << bits) + b;
        prop_assert_eq!(value.to_f64(), value.to_string().parse::<f64>().unwrap());
    }

    #[test]
    fn order_is_total(a in integers(), b in integers()) {
        let expected = match reference(&(&a - &b)).sign() {
            num_bigint::Sign::Minus => Ordering::Less,
            num_bigint::Sign::NoSign => Ordering::Equal,
            num_bigint::Sign::Plus => Ordering::Greater,
        };
        prop_assert_eq!(a.cmp(&b), expected);
        prop_assert_eq!(a.partial_cmp(&b), Some(expected));
    }
}
