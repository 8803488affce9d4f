//! Decimals rounded in a stated direction.
//!
//! All functions print plain decimals for magnitudes from 1e-6 to below 1e15, and the form "1.25e-12" for others.
//! Zeros after the last non-zero decimal are left out, so a number that has few digits is printed short, in both
//! directions alike.

use super::{Integer, Rational};

/// The largest decimal of the given number of significant digits that is ≤ x (towards −∞); 0 digits count as 1.
///
/// ```
/// use knotproof::number::{Rational, RationalExt, decimal_down, decimal_up};
/// let x = Rational::parse_canonical("2/3").unwrap();
/// assert_eq!(decimal_down(&x, 4), "0.6666");
/// assert_eq!(decimal_up(&x, 4), "0.6667");
/// ```
pub fn decimal_down(x: &Rational, significant: usize) -> String {
    decimal(x, significant, x.numer().is_negative())
}

/// The smallest decimal of the given number of significant digits that is ≥ x (towards +∞); 0 digits count as 1.
pub fn decimal_up(x: &Rational, significant: usize) -> String {
    decimal(x, significant, x.numer().is_positive())
}

/// The largest decimal of the given number of significant digits that is ≤ √square; 0 digits count as 1.
///
/// # Panics
/// When `square` is negative.
pub fn sqrt_decimal_down(square: &Rational, significant: usize) -> String {
    sqrt_decimal(square, significant, false)
}

/// The smallest decimal of the given number of significant digits that is ≥ √square; 0 digits count as 1.
///
/// # Panics
/// When `square` is negative.
pub fn sqrt_decimal_up(square: &Rational, significant: usize) -> String {
    sqrt_decimal(square, significant, true)
}

/// How many significant digits are worth printing of the two ends of an interval: enough to tell the ends apart, plus
/// two, so that outward rounding widens the interval by less than 2 %. 17 when the ends are equal.
pub fn interval_digits(lower: &Rational, upper: &Rational) -> usize {
    let width = magnitude(&(upper - lower));
    let Some(width_decade) = decade(&width) else {
        return 17;
    };
    let larger = magnitude(lower).max(magnitude(upper));
    let larger_decade = decade(&larger).unwrap_or(width_decade);
    usize::try_from(larger_decade - width_decade + 3).unwrap_or(1).max(1)
}

fn decimal(x: &Rational, significant: usize, away_from_zero: bool) -> String {
    let magnitude = magnitude(x);
    let Some(decade) = decade(&magnitude) else {
        return "0".to_owned();
    };
    let places = last_place(significant) - decade;
    let (numerator, denominator) = scaled(&magnitude, places);
    let digits = if away_from_zero {
        numerator.div_ceil(&denominator)
    } else {
        numerator.div_floor(&denominator)
    };
    render(x.numer().is_negative(), &digits, -places)
}

fn sqrt_decimal(square: &Rational, significant: usize, up: bool) -> String {
    assert!(!square.numer().is_negative(), "square root of a negative number");
    let Some(decade) = decade(square) else {
        return "0".to_owned();
    };
    let places = last_place(significant) - decade.div_euclid(2);
    let (numerator, denominator) = scaled(square, 2 * places);
    let (floor, rest) = numerator.div_rem(&denominator);
    let root = floor.sqrt_floor().unwrap_or_default();
    let exact = rest.is_zero() && &root * &root == floor;
    let digits = if up && !exact { root + Integer::ONE } else { root };
    render(false, &digits, -places)
}

/// The place of the last significant digit, counted from the first.
fn last_place(significant: usize) -> i64 {
    i64::try_from(significant).unwrap_or(i64::MAX).max(1) - 1
}

fn magnitude(x: &Rational) -> Rational {
    Rational::new_raw(x.numer().abs(), x.denom().clone())
}

/// 10^|exponent|.
fn power_of_ten(exponent: i64) -> Integer {
    Integer::from(10).pow(u32::try_from(exponent.unsigned_abs()).expect("more digits than memory holds"))
}

/// x · 10^places as numerator and denominator.
fn scaled(x: &Rational, places: i64) -> (Integer, Integer) {
    let power = power_of_ten(places);
    if places >= 0 {
        (x.numer() * power, x.denom().clone())
    } else {
        (x.numer().clone(), x.denom() * power)
    }
}

/// ⌊log₁₀ x⌋ for x > 0; `None` for 0.
fn decade(x: &Rational) -> Option<i64> {
    if x.numer().is_zero() {
        return None;
    }
    // x lies strictly between 2^(binary - 1) and 2^(binary + 1), so the guess is too small by at most two.
    let binary = x.numer().bits() as i64 - x.denom().bits() as i64;
    let mut decade = ((binary - 1) as f64 * std::f64::consts::LOG10_2 - 1e-3).floor() as i64;
    while {
        let (numerator, denominator) = scaled(x, -(decade + 1));
        numerator >= denominator
    } {
        decade += 1;
    }
    Some(decade)
}

/// The text of ±digits · 10^exponent, for digits > 0.
fn render(negative: bool, digits: &Integer, exponent: i64) -> String {
    let all = digits.to_string();
    let digits = all.trim_end_matches('0');
    // Of the first digit.
    let decade = all.len() as i64 - 1 + exponent;
    let sign = if negative { "-" } else { "" };
    if !(-6..15).contains(&decade) {
        let (first, others) = digits.split_at(1);
        let point = if others.is_empty() { "" } else { "." };
        return format!("{sign}{first}{point}{others}e{decade}");
    }
    if decade < 0 {
        let zeros = "0".repeat((-decade - 1) as usize);
        return format!("{sign}0.{zeros}{digits}");
    }
    let whole = decade as usize + 1;
    if digits.len() <= whole {
        let zeros = "0".repeat(whole - digits.len());
        format!("{sign}{digits}{zeros}")
    } else {
        format!("{sign}{}.{}", &digits[..whole], &digits[whole..])
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::number::generate::{positive_rationals, rationals};
    use crate::number::{Meaning, parse_number};

    fn read(text: &str) -> Rational {
        parse_number(text, Meaning::Decimal).unwrap()
    }

    /// One unit in the last of `significant` places of x > 0, the place of the first found by counting up or down.
    fn unit(x: &Rational, significant: usize) -> Rational {
        let (one, ten) = (
            Rational::from_integer(Integer::ONE),
            Rational::from_integer(Integer::from(10)),
        );
        let mut power = one;
        while power > *x {
            power /= &ten;
        }
        while &power * &ten <= *x {
            power *= &ten;
        }
        for _ in 1..significant {
            power /= &ten;
        }
        power
    }

    fn significant_digits(text: &str) -> usize {
        let mantissa = text.split('e').next().unwrap_or_default();
        let digits: String = mantissa.chars().filter(char::is_ascii_digit).collect();
        let digits = digits.trim_start_matches('0');
        if mantissa.contains('.') {
            digits.len()
        } else {
            digits.trim_end_matches('0').len()
        }
    }

    #[test]
    fn forms() {
        for (text, expected) in [
            ("0", "0"),
            ("2", "2"),
            ("-2.50", "-2.5"),
            ("100", "100"),
            ("0.000001", "0.000001"),
            ("0.00000099", "9.9e-7"),
            ("1e-7", "1e-7"),
            ("-1.25e-12", "-1.25e-12"),
            ("999999999999999", "999999999999999"),
            ("1e15", "1e15"),
            ("123456789012345.5", "123456789012345.5"),
            ("1234567890123456", "1.234567890123456e15"),
            ("-1e300", "-1e300"),
            ("10.01", "10.01"),
        ] {
            assert_eq!(decimal_down(&read(text), 17), expected);
            assert_eq!(decimal_up(&read(text), 17), expected);
        }
        for (x, significant, down, up) in [
            ("2/3", 3, "0.666", "0.667"),
            ("-2/3", 3, "-0.667", "-0.666"),
            ("99.99", 3, "99.9", "100"),
            ("-99.99", 3, "-100", "-99.9"),
            ("123456", 3, "123000", "124000"),
            ("999999999999999.9", 15, "999999999999999", "1e15"),
            ("0.0000009999", 2, "9.9e-7", "0.000001"),
            ("7.5", 0, "7", "8"),
            ("7.5", 1, "7", "8"),
        ] {
            assert_eq!(decimal_down(&read(x), significant), down);
            assert_eq!(decimal_up(&read(x), significant), up);
        }
    }

    #[test]
    fn roots() {
        let square_root = |text, significant| {
            let square = read(text);
            (
                sqrt_decimal_down(&square, significant),
                sqrt_decimal_up(&square, significant),
            )
        };
        let pair = |down: &str, up: &str| (down.to_owned(), up.to_owned());
        assert_eq!(square_root("4", 17), pair("2", "2"));
        assert_eq!(square_root("0", 17), pair("0", "0"));
        assert_eq!(square_root("2", 18), pair("1.41421356237309504", "1.41421356237309505"));
        assert_eq!(square_root("2e-30", 4), pair("1.414e-15", "1.415e-15"));
        assert_eq!(square_root("1/16", 5), pair("0.25", "0.25"));
        assert_eq!(square_root("0.99999", 3), pair("0.999", "1"));
        assert_eq!(square_root("152399025", 3), pair("12300", "12400"));
        // 12345² = 152399025.
        assert_eq!(square_root("152399025", 5), pair("12345", "12345"));
    }

    #[test]
    fn digits_of_intervals() {
        let digits = |lower: &str, upper: &str| interval_digits(&read(lower), &read(upper));
        assert_eq!(digits("0.44267517", "0.44267518"), 10);
        assert_eq!(digits("1", "2"), 3);
        assert_eq!(digits("-1", "1"), 3);
        assert_eq!(digits("0", "1e-9"), 3);
        assert_eq!(digits("99", "101"), 5);
        assert_eq!(digits("5", "5"), 17);
        assert_eq!(digits("0", "0"), 17);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]

        #[test]
        fn nearest_in_each_direction(x in rationals(), significant in 1_usize..30) {
            let (down, up) = (decimal_down(&x, significant), decimal_up(&x, significant));
            prop_assert!(significant_digits(&down) <= significant, "{down}");
            prop_assert!(significant_digits(&up) <= significant, "{up}");
            let (lower, upper) = (read(&down), read(&up));
            prop_assert!(lower <= x && x <= upper);
            if x.numer().is_zero() {
                prop_assert_eq!(down, "0");
            } else {
                let unit = unit(&magnitude(&x), significant);
                // Neighbours on the grid, or the same point of it.
                let grid = (&x / &unit).is_integer();
                let width = if grid { Rational::from_integer(Integer::ZERO) } else { unit };
                prop_assert_eq!(upper - lower, width);
            }
        }

        #[test]
        fn roots_nearest_in_each_direction(square in positive_rationals(), significant in 1_usize..30) {
            let down = read(&sqrt_decimal_down(&square, significant));
            let up = read(&sqrt_decimal_up(&square, significant));
            prop_assert!(&down * &down <= square && square <= &up * &up);
            if down == up {
                prop_assert_eq!(&down * &down, square);
            } else {
                prop_assert_eq!(&up - &down, unit(&down, significant));
            }
        }

        #[test]
        fn roots_of_short_squares(root in 0_u32..10_000_000, places in -30_i32..30) {
            let x = read(&format!("{root}e{places}"));
            let text = decimal_down(&x, 10);
            let square = &x * &x;
            prop_assert_eq!(sqrt_decimal_down(&square, 10), text.clone());
            prop_assert_eq!(sqrt_decimal_up(&square, 10), text);
        }

        #[test]
        fn outward_rounding_widens_little(lower in rationals(), width in positive_rationals()) {
            let upper = &lower + &width;
            let digits = interval_digits(&lower, &upper);
            let printed = read(&decimal_up(&upper, digits)) - read(&decimal_down(&lower, digits));
            let limit = width * Rational::new(Integer::from(51), Integer::from(50));
            prop_assert!(printed < limit);
        }
    }
}
