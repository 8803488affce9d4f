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
    usize::try_from(larger_decade - width_decade + 3)
        .unwrap_or(1)
        .max(1)
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
    assert!(
        !square.numer().is_negative(),
        "square root of a negative number"
    );
    let Some(decade) = decade(square) else {
        return "0".to_owned();
    };
    let places = last_place(significant) - decade.div_euclid(2);
    let (numerator, denominator) = scaled(square, 2 * places);
    let (floor, rest) = numerator.div_rem(&denominator);
    let root = floor.sqrt_floor().unwrap_or_default();
    let exact = rest.is_zero() && &root * &root == floor;
    let digits = if up && !exact {
        root + Integer::ONE
    } else {
        root
    };
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
    Integer::from(10)
        .pow(u32::try_from(exponent.unsigned_abs()).expect("more digits than memory holds"))
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
