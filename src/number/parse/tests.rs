//! Against the standard library, against slow exact arithmetic, and by examples of every error.

use proptest::prelude::*;

use super::*;
use crate::number::generate::finite;

fn decimal(text: &str) -> Rational {
    parse_number(text, Meaning::Decimal).unwrap()
}

/// The value by one multiplication or division by ten per place, with no regard to speed.
fn naive(text: &str) -> Rational {
    let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let ten = Rational::from_integer(Integer::from(10));
    let mut value = Rational::from_integer(Integer::ZERO);
    let mut places: i64 = exponent.parse().unwrap();
    let mut after_point = false;
    for character in mantissa.chars() {
        match character {
            '.' => after_point = true,
            '+' | '-' => {}
            digit => {
                let digit = Integer::from(digit.to_digit(10).unwrap());
                value = value * &ten + Rational::from_integer(digit);
                places -= i64::from(after_point);
            }
        }
    }
    for _ in 0..places.abs() {
        value = if places > 0 { value * &ten } else { value / &ten };
    }
    if mantissa.starts_with('-') { -value } else { value }
}

fn decimal_texts() -> impl Strategy<Value = String> {
    let mantissa = prop_oneof![
        "[0-9]{1,25}",
        "[0-9]{1,12}\\.[0-9]{0,30}",
        "\\.[0-9]{1,20}",
        "0\\.0{0,9}[1-9]0{0,30}"
    ];
    let exponent = prop_oneof!["", "[eE][+-]?[0-9]{1,2}", "[eE][+-]?[0-3][0-9]{2}"];
    ("[+-]?", mantissa, exponent).prop_map(|(sign, mantissa, exponent)| sign + &mantissa + &exponent)
}

#[test]
fn values() {
    for (text, expected) in [
        ("0", "0"),
        ("-0", "0"),
        ("-0.0e5", "0"),
        ("0.2", "1/5"),
        ("-1.5e3", "-1500"),
        (".5", "1/2"),
        ("1.", "1"),
        ("+1", "1"),
        ("007", "7"),
        ("1e-3", "1/1000"),
        ("0.5e1", "5"),
        ("6/4", "3/2"),
        ("-6/4", "-3/2"),
        ("+0/9", "0"),
        ("1/3", "1/3"),
        ("0x1.8p1", "3"),
        ("-0x.8", "-1/2"),
        ("0XfFP-2", "255/4"),
        ("0x0p5", "0"),
        ("0x10000000000000000.8p0", "36893488147419103233/2"),
    ] {
        assert_eq!(decimal(text).format(), expected, "{text}");
    }
    let fifth = parse_number("0.2", Meaning::Binary64).unwrap();
    assert_eq!(fifth.format(), "3602879701896397/18014398509481984");
    // Fractions and hexadecimal numbers are exact under both meanings.
    for text in ["1/5", "0x1.00000000000000001p0"] {
        assert_eq!(
            parse_number(text, Meaning::Binary64),
            parse_number(text, Meaning::Decimal)
        );
        assert_ne!(Rational::from_f64(decimal(text).to_f64()), Some(decimal(text)));
    }
}

#[test]
fn texts_refused() {
    let message = |text: &str| parse_number(text, Meaning::Decimal).unwrap_err().to_string();
    for (text, expected) in [
        ("", "empty"),
        ("-", "ends"),
        (".", "ends"),
        ("-.", "ends"),
        ("1e", "ends"),
        ("1e+", "ends"),
        ("0x", "ends"),
        ("0x1p", "ends"),
        ("1/", "ends"),
        ("/2", "character 1"),
        ("--1", "character 2"),
        ("+-1", "character 2"),
        (" 1", "character 1"),
        ("1 ", "character 2"),
        ("1,5", "character 2"),
        ("1.2.3", "character 4"),
        ("1e5x", "character 4"),
        ("1e1.5", "character 4"),
        ("1_000", "character 2"),
        ("e5", "character 1"),
        (".e5", "character 2"),
        ("0x1g", "character 4"),
        ("0x1p0x1", "character 6"),
        ("0x-1", "character 3"),
        ("1.5/2", "character 2"),
        ("1/2.5", "character 4"),
        ("1/-2", "character 3"),
        ("1/2/3", "character 4"),
        ("½", "character 1"),
        ("1é5", "'é' at character 2"),
        ("éé", "character 1"),
        ("٣", "character 1"),
        ("nano", "character 1"),
        ("1f", "character 2"),
    ] {
        let error = message(text);
        assert!(error.contains(expected), "{text:?}: {error}");
    }
    for text in ["NaN", "nan", "-nan", "inf", "+Infinity", "-INF"] {
        let error = parse_number(text, Meaning::Decimal);
        assert_eq!(error, Err(NumberError::NotFinite { text: text.into() }));
    }
    for text in ["1/0", "-0/00"] {
        let error = parse_number(text, Meaning::Binary64);
        assert_eq!(error, Err(NumberError::ZeroDenominator { text: text.into() }));
    }
}

#[test]
fn sizes_are_bounded() {
    let longest = "9".repeat(MAXIMUM_LENGTH);
    assert_eq!(decimal(&longest).format(), longest);
    let error = parse_number(&(longest + "9"), Meaning::Decimal).unwrap_err();
    assert!(matches!(
        error,
        NumberError::TooLong {
            length: 4097,
            limit: 4096,
            ..
        }
    ));
    assert!(error.to_string().len() < 200);
    for text in [
        "1e10001",
        "0e-10001",
        "0x1p10001",
        "1e99999999999999999999999",
        "1e-99999999999999999999",
    ] {
        let error = parse_number(text, Meaning::Decimal);
        assert!(matches!(error, Err(NumberError::ExponentTooLarge { .. })), "{text}");
    }
    assert_eq!(decimal("1e10000").numer(), &Integer::from(10).pow(10_000));
    assert_eq!(decimal("1e-10000").denom(), &Integer::from(10).pow(10_000));
    assert_eq!(decimal("0x1p-10000").denom(), &(Integer::ONE << 10_000));
    assert_eq!(decimal("1e0010000"), decimal("1e10000"));
    let long = format!("0.{}1e-10000", "0".repeat(4000));
    assert_eq!(decimal(&long).denom(), &Integer::from(10).pow(14_001));
}

#[test]
fn binary64_overflow_and_underflow() {
    for text in ["1e309", "-1.8e308", "1e10000", "1.797693134862315808e308"] {
        let error = parse_number(text, Meaning::Binary64);
        assert!(matches!(error, Err(NumberError::Overflow { .. })), "{text}");
        assert!(parse_number(text, Meaning::Decimal).is_ok());
    }
    let largest = parse_number("1.7976931348623157e308", Meaning::Binary64).unwrap();
    assert_eq!(largest.to_f64(), f64::MAX);
    // Just below the middle between the largest finite number and 2^1024.
    let below = parse_number("1.7976931348623158079e308", Meaning::Binary64);
    assert_eq!(below, Ok(largest));
    assert_eq!(parse_number("1e-400", Meaning::Binary64).unwrap().format(), "0");
    let least = parse_number("4.9e-324", Meaning::Binary64).unwrap();
    assert_eq!(least.to_f64(), f64::from_bits(1));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn decimal_against_naive(text in decimal_texts()) {
        let value = decimal(&text);
        prop_assert_eq!(&value, &naive(&text));
        let again = Rational::new(value.numer().clone(), value.denom().clone());
        prop_assert_eq!((value.numer(), value.denom()), (again.numer(), again.denom()));
    }

    #[test]
    fn binary64_against_the_standard_library(text in decimal_texts()) {
        let expected: f64 = text.parse().unwrap();
        let value = parse_number(&text, Meaning::Binary64);
        prop_assert_eq!(value.ok(), Rational::from_f64(expected));
    }

    #[test]
    fn shortest_decimals_return(value in finite()) {
        let exact = Rational::from_f64(value);
        for text in [format!("{value}"), format!("{value:e}"), format!("{value:.800}")] {
            prop_assert_eq!(&parse_number(&text, Meaning::Binary64).ok(), &exact);
        }
    }

    #[test]
    fn ties_go_to_even(value in finite(), nudge in 0..3) {
        // The middle of two neighbours, written out: n / 2^k = n · 5^k / 10^k. A digit 1 far behind breaks the tie.
        let next = if value.abs().next_up().is_finite() { value.abs().next_up() } else { value.abs() };
        let sum = Rational::from_f64(value.abs()).unwrap() + Rational::from_f64(next).unwrap();
        let middle = sum / Rational::from_integer(Integer::from(2));
        let places = middle.denom().bits() as u32 - 1;
        let digits = middle.numer() * Integer::from(5).pow(places);
        let text = match nudge {
            0 => format!("{digits}e-{places}"),
            1 => format!("{digits}.000000000000000000000001e-{places}"),
            _ => format!("{}.999999999999999999999999e-{places}", digits - Integer::ONE),
        };
        let value = parse_number(&text, Meaning::Binary64);
        prop_assert_eq!(value.ok(), Rational::from_f64(text.parse().unwrap()));
    }

    #[test]
    fn hexadecimal_value(digits in "[0-9a-fA-F]{1,40}", point in 0_usize..40, exponent in -300_i32..300, negative in any::<bool>()) {
        let point = point.min(digits.len());
        let sign = if negative { "-" } else { "" };
        let text = format!("{sign}0x{}.{}p{exponent}", &digits[..point], &digits[point..]);
        let sixteen = Rational::from_integer(Integer::from(16));
        let two = Rational::from_integer(Integer::from(2));
        let mut expected = Rational::from_integer(Integer::ZERO);
        for digit in digits.chars() {
            expected = expected * &sixteen + Rational::from_integer(Integer::from(digit.to_digit(16).unwrap()));
        }
        for _ in point..digits.len() {
            expected /= &sixteen;
        }
        for _ in 0..exponent.abs() {
            expected = if exponent > 0 { expected * &two } else { expected / &two };
        }
        let expected = if negative { -expected } else { expected };
        let value = decimal(&text);
        prop_assert_eq!(&value, &expected);
        prop_assert_eq!((value.numer(), value.denom()), (expected.numer(), expected.denom()));
    }

    #[test]
    fn no_text_panics(text in "[-+0-9a-fxpeE./ é]{0,12}|.{0,12}", binary in any::<bool>()) {
        let meaning = if binary { Meaning::Binary64 } else { Meaning::Decimal };
        if let Err(error) = parse_number(&text, meaning) {
            prop_assert!(!error.to_string().is_empty());
        }
    }

    #[test]
    fn whole_grammar_at_once(text in "[-+]?[0-9.]{0,6}([eE][-+]?[0-9]{0,3})?") {
        // Over these characters, the standard library's grammar is the same.
        let expected = text.parse::<f64>();
        match parse_number(&text, Meaning::Binary64) {
            Ok(value) => prop_assert_eq!(Some(value), Rational::from_f64(expected.unwrap())),
            Err(NumberError::Overflow { .. }) => prop_assert!(expected.unwrap().is_infinite()),
            Err(_) => prop_assert!(expected.is_err()),
        }
    }
}
