//! Texts of numbers as files write them.
//!
//! | form | examples | value |
//! | --- | --- | --- |
//! | decimal | `12`, `-1.5e3`, `.5`, `1.`, `+1`, `007` | as [`Meaning`] says |
//! | fraction | `1/5`, `-6/4` | exact |
//! | hexadecimal | `0x1.8p1`, `-0x.8`, `0xffP-2` | exact |
//!
//! A sign, '-' or '+', may stand in front, and nowhere else but in an exponent. A decimal or hexadecimal number has a
//! digit before or after the point, an exponent at least one digit; the hexadecimal exponent is a power of two in
//! decimal digits, and may be left out. A fraction consists of decimal digits around one '/'. Spaces, separators and
//! suffixes are errors. This is a superset of the numbers of JSON.

#[cfg(test)]
mod tests;

use super::error::quote;
use super::rational::quotient_to_f64;
use super::{Integer, NumberError, Rational, RationalExt};

/// The largest number of characters of a number.
pub const MAXIMUM_LENGTH: usize = 4096;

/// The largest magnitude of a written exponent, of ten or of two.
pub const MAXIMUM_EXPONENT: u32 = 10_000;

/// What a decimal text means. Fractions and hexadecimal numbers mean their exact value always.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Meaning {
    /// The decimal value itself: "0.2" is 1/5.
    Decimal,
    /// The binary64 nearest to the decimal value, ties to even: "0.2" is 3602879701896397/2^54.
    Binary64,
}

/// Reads a number; the module's table says which texts are numbers.
///
/// # Errors
/// A [`NumberError`] of its own for the empty text, a text that is no number (with the position), NaN and infinities,
/// a zero denominator, more than [`MAXIMUM_LENGTH`] characters, an exponent beyond ±[`MAXIMUM_EXPONENT`], and, under
/// [`Meaning::Binary64`], a decimal that rounds to an infinity.
pub fn parse_number(text: &str, meaning: Meaning) -> Result<Rational, NumberError> {
    if text.is_empty() {
        return Err(NumberError::Empty);
    }
    if text.len() > MAXIMUM_LENGTH {
        return Err(NumberError::TooLong {
            text: quote(text),
            length: text.len(),
            limit: MAXIMUM_LENGTH,
        });
    }
    let mut cursor = Cursor { text, offset: 0 };
    let negative = cursor.sign();
    let rest = cursor.rest();
    if ["nan", "inf", "infinity"]
        .iter()
        .any(|word| rest.eq_ignore_ascii_case(word))
    {
        return Err(NumberError::NotFinite { text: quote(text) });
    }
    let magnitude = if rest.starts_with("0x") || rest.starts_with("0X") {
        cursor.offset += 2;
        hexadecimal(&mut cursor)?
    } else {
        decimal_or_fraction(&mut cursor, meaning)?
    };
    Ok(if negative { -magnitude } else { magnitude })
}

/// A place in a text.
struct Cursor<'a> {
    text: &'a str,
    offset: usize,
}

impl<'a> Cursor<'a> {
    fn rest(&self) -> &'a str {
        &self.text[self.offset..]
    }

    fn unexpected(&self) -> NumberError {
        NumberError::unexpected(self.text, self.offset)
    }

    /// Passes one character if it is among the given ASCII characters.
    fn pass(&mut self, among: &[u8]) -> Option<u8> {
        let byte = *self.text.as_bytes().get(self.offset)?;
        among.contains(&byte).then(|| {
            self.offset += 1;
            byte
        })
    }

    /// Passes an optional sign; whether it was '-'.
    fn sign(&mut self) -> bool {
        self.pass(b"+-") == Some(b'-')
    }

    /// Passes the longest run of digits, which may be empty.
    fn digits(&mut self, is_digit: fn(&u8) -> bool) -> &'a str {
        let rest = self.rest();
        let length = rest.bytes().take_while(is_digit).count();
        self.offset += length;
        &rest[..length]
    }

    /// Passes an exponent if one of `letters` stands here; 0 without one.
    fn exponent(&mut self, letters: &[u8]) -> Result<i64, NumberError> {
        if self.pass(letters).is_none() {
            return Ok(0);
        }
        let negative = self.sign();
        let digits = self.digits(u8::is_ascii_digit);
        if digits.is_empty() || !self.rest().is_empty() {
            return Err(self.unexpected());
        }
        let magnitude = digits.bytes().fold(0_u32, |value, digit| {
            value.saturating_mul(10).saturating_add(u32::from(digit - b'0'))
        });
        if magnitude > MAXIMUM_EXPONENT {
            return Err(NumberError::ExponentTooLarge {
                text: quote(self.text),
                limit: MAXIMUM_EXPONENT,
            });
        }
        Ok(if negative {
            -i64::from(magnitude)
        } else {
            i64::from(magnitude)
        })
    }

    /// Passes digits with an optional point among them and an optional exponent, up to the end of the text.
    fn scientific(&mut self, is_digit: fn(&u8) -> bool, letters: &[u8]) -> Result<Scientific<'a>, NumberError> {
        let whole = self.digits(is_digit);
        let fraction = if self.pass(b".").is_some() {
            self.digits(is_digit)
        } else {
            ""
        };
        if whole.is_empty() && fraction.is_empty() {
            return Err(self.unexpected());
        }
        let exponent = self.exponent(letters)?;
        if self.rest().is_empty() {
            Ok(Scientific {
                whole,
                fraction,
                exponent,
            })
        } else {
            Err(self.unexpected())
        }
    }
}

/// The digits before and after the point, at least one in all, and the written exponent.
struct Scientific<'a> {
    whole: &'a str,
    fraction: &'a str,
    exponent: i64,
}

impl Scientific<'_> {
    fn digits(&self) -> impl DoubleEndedIterator<Item = u8> {
        self.whole.bytes().chain(self.fraction.bytes())
    }

    /// The decimal digits in a row, as one integer.
    fn decimal_digits(&self) -> Option<Integer> {
        if self.whole.len() + self.fraction.len() <= 18 {
            let value = self
                .digits()
                .fold(0, |value, digit| 10 * value + i64::from(digit - b'0'));
            return Some(Integer::from(value));
        }
        Integer::from_digits(&format!("{}{}", self.whole, self.fraction))
    }
}

fn hexadecimal(cursor: &mut Cursor) -> Result<Rational, NumberError> {
    let scientific = cursor.scientific(u8::is_ascii_hexdigit, b"pP")?;
    let nibbles: Vec<u8> = scientific
        .digits()
        .rev()
        .filter_map(|digit| char::from(digit).to_digit(16))
        .map(|digit| digit as u8)
        .collect();
    let bytes: Vec<u8> = nibbles
        .chunks(2)
        .map(|pair| pair[0] | pair.get(1).map_or(0, |high| high << 4))
        .collect();
    let numerator = Integer::from_magnitude_bytes_le(false, &bytes);
    // Both parts of the exponent are bounded by the limits above, far inside u32.
    let exponent = scientific.exponent - 4 * scientific.fraction.len() as i64;
    let shift = exponent.unsigned_abs() as u32;
    Ok(if exponent >= 0 {
        Rational::from_integer(numerator << shift)
    } else {
        let common = numerator
            .trailing_zeros()
            .map_or(shift, |zeros| zeros.min(u64::from(shift)) as u32);
        Rational::new_raw(numerator >> common, Integer::ONE << (shift - common))
    })
}

fn decimal_or_fraction(cursor: &mut Cursor, meaning: Meaning) -> Result<Rational, NumberError> {
    let text = cursor.text;
    if let Some(slash) = cursor.rest().find('/') {
        let slash = cursor.offset + slash;
        let part = |start: usize, end: usize| {
            Integer::from_digits(&text[start..end]).ok_or_else(|| NumberError::not_digits(text, start, end))
        };
        let numerator = part(cursor.offset, slash)?;
        let denominator = part(slash + 1, text.len())?;
        if denominator.is_zero() {
            return Err(NumberError::ZeroDenominator { text: quote(text) });
        }
        return Ok(Rational::new(numerator, denominator));
    }
    let scientific = cursor.scientific(u8::is_ascii_digit, b"eE")?;
    let digits = scientific.decimal_digits().ok_or_else(|| cursor.unexpected())?;
    let exponent = scientific.exponent - scientific.fraction.len() as i64;
    match meaning {
        Meaning::Decimal => Ok(decimal_value(digits, exponent)),
        Meaning::Binary64 => {
            let power = Integer::from(10).pow(exponent.unsigned_abs() as u32);
            let nearest = if exponent >= 0 {
                (digits * power).to_f64()
            } else {
                quotient_to_f64(&digits, &power)
            };
            Rational::from_f64(nearest).ok_or_else(|| NumberError::Overflow { text: quote(text) })
        }
    }
}

/// digits · 10^exponent.
fn decimal_value(digits: Integer, exponent: i64) -> Rational {
    let places = exponent.unsigned_abs() as u32;
    if digits.is_zero() {
        return Rational::from_integer(Integer::ZERO);
    }
    if exponent >= 0 {
        return Rational::from_integer(digits * Integer::from(10).pow(places));
    }
    // 10^places = 2^places · 5^places: the two common divisors are found apart, the first without division.
    let twos = digits.trailing_zeros().unwrap_or(0).min(u64::from(places)) as u32;
    let power = Integer::from(5).pow(places);
    let numerator = digits >> twos;
    if !(&numerator % Integer::from(5)).is_zero() {
        return Rational::new_raw(numerator, power << (places - twos));
    }
    let fives = numerator.gcd(&power);
    Rational::new_raw(numerator.div_exact(&fives), power.div_exact(&fives) << (places - twos))
}
