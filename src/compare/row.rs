//! One number of one method.

use std::borrow::Cow;

use crate::number::{Rational, decimal_down, decimal_up, interval_digits, sqrt_decimal_down, sqrt_decimal_up};

/// Digits of a number that stands alone.
const DIGITS: usize = 10;
/// Intervals that need more digits than these are printed as numbers.
const MOST_DIGITS: usize = 17;

/// What a number rests on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// Computed exactly or enclosed, by its definition.
    Exact,
    /// Computed by the formula or algorithm of the paper; as a statement about the curve it is not proved.
    Printed,
    /// A statement about the curve, by a theorem of the documentation.
    Proved,
    /// A statement about the curve that the checker accepted.
    Certified,
    /// Enclosed by another program with outward rounding; nothing is left to check.
    Interval,
    /// Computed in binary64, with rounding; not proved.
    Binary64,
    /// A time.
    Measured,
    /// Not told.
    Undecided,
}

impl Standing {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Standing::Exact => "exact",
            Standing::Printed => "as printed",
            Standing::Proved => "proved",
            Standing::Certified => "certified",
            Standing::Interval => "interval",
            Standing::Binary64 => "binary64",
            Standing::Measured => "measured",
            Standing::Undecided => "undecided",
        }
    }
}

/// A number, or bounds of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Value {
    /// A whole number.
    Count(i64),
    /// A fraction.
    Number(Rational),
    /// Bounds; `None` for an upper bound that is not known.
    Between(Rational, Option<Rational>),
    /// Bounds of a number whose squares are given; `None` for an upper bound that is not known.
    RootBetween(Rational, Option<Rational>),
    /// Infinite.
    Infinite,
    /// None; the remark says why.
    None,
}

impl Value {
    /// √x of an exact square.
    pub fn root(squared: Rational) -> Value {
        Value::RootBetween(squared.clone(), Some(squared))
    }

    /// Decimals (lower, upper), rounded outward; "inf" for infinite ones. Bounds have as many digits as it takes to tell them apart.
    pub fn decimals(&self) -> (Option<String>, Option<String>) {
        self.decimals_with(match self {
            Value::Between(lower, Some(upper)) | Value::RootBetween(lower, Some(upper)) => digits(lower, upper),
            _ => DIGITS,
        })
    }

    /// The same with so many digits.
    pub fn decimals_with(&self, digits: usize) -> (Option<String>, Option<String>) {
        match self {
            Value::Count(count) => (Some(count.to_string()), Some(count.to_string())),
            Value::Number(x) => (Some(decimal_down(x, digits)), Some(decimal_up(x, digits))),
            Value::Between(lower, upper) => (
                Some(decimal_down(lower, digits)),
                upper.as_ref().map(|upper| decimal_up(upper, digits)),
            ),
            Value::RootBetween(lower, upper) => (
                Some(sqrt_decimal_down(lower, digits)),
                upper.as_ref().map(|upper| sqrt_decimal_up(upper, digits)),
            ),
            Value::Infinite => (Some("inf".into()), Some("inf".into())),
            Value::None => (None, None),
        }
    }
}

/// Enough digits to tell the bounds apart, and not fewer than those of a number alone; so few also where the bounds are a number that is not rational,
/// enclosed so narrowly that nothing is learnt from more.
fn digits(lower: &Rational, upper: &Rational) -> usize {
    match interval_digits(lower, upper) {
        needed if lower == upper || needed > MOST_DIGITS => DIGITS,
        needed => needed.max(DIGITS),
    }
}

/// One row of a comparison.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// Whose number it is: "CPJ12", "certified", ….
    pub method: &'static str,
    /// A name for programs, the same in every comparison: "cpj12.m1", "gkk09.3.measure", ….
    pub key: Cow<'static, str>,
    /// What it is a number of, for people.
    pub quantity: String,
    /// The number.
    pub value: Value,
    /// What it rests on.
    pub standing: Standing,
    /// What else there is to say.
    pub remark: Option<String>,
}

impl Row {
    /// A row without a remark.
    pub fn new(
        method: &'static str,
        key: impl Into<Cow<'static, str>>,
        quantity: impl Into<String>,
        value: Value,
        standing: Standing,
    ) -> Row {
        Row {
            method,
            key: key.into(),
            quantity: quantity.into(),
            value,
            standing,
            remark: None,
        }
    }

    /// The same with a remark if it has no value.
    pub fn if_none(mut self, remark: &str) -> Row {
        if self.value == Value::None {
            self.remark = Some(remark.into());
        }
        self
    }

    /// The same with a remark.
    pub fn remark(mut self, remark: impl Into<String>) -> Row {
        self.remark = Some(remark.into());
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_are_rounded_outward() {
        let fraction = |p: i64, q: i64| Rational::new(p.into(), q.into());
        let text = |value: Value| {
            let (lower, upper) = value.decimals();
            (lower.unwrap_or_default(), upper.unwrap_or_default())
        };
        let pair = |lower: &str, upper: &str| (lower.to_string(), upper.to_string());
        assert_eq!(text(Value::Count(-3)), pair("-3", "-3"));
        assert_eq!(
            text(Value::Number(fraction(2, 3))),
            pair("0.6666666666", "0.6666666667")
        );
        assert_eq!(text(Value::root(fraction(9, 4))), pair("1.5", "1.5"));
        assert_eq!(text(Value::root(fraction(2, 1))), pair("1.414213562", "1.414213563"));
        assert_eq!(text(Value::Between(fraction(1, 2), None)), pair("0.5", ""));
        assert_eq!(
            text(Value::RootBetween(fraction(1, 4), Some(fraction(2, 1)))),
            pair("0.5", "1.414213563")
        );
        assert_eq!(text(Value::Infinite), pair("inf", "inf"));
        assert_eq!(text(Value::None), pair("", ""));
    }
}
