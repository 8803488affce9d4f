//! Primitive integers, text and bytes.

use std::fmt;
use std::str::FromStr;

use super::{Integer, Large, Small, backend};
use crate::number::NumberError;

macro_rules! from_small {
    ($($primitive:ty),*) => {$(
        impl From<$primitive> for Integer {
            #[inline]
            fn from(value: $primitive) -> Self {
                Integer::small(i64::from(value))
            }
        }
    )*};
}
from_small!(i8, i16, i32, i64, u8, u16, u32);

impl From<u64> for Integer {
    #[inline]
    fn from(value: u64) -> Self {
        Integer::wide(i128::from(value))
    }
}

impl From<usize> for Integer {
    #[inline]
    fn from(value: usize) -> Self {
        Integer::from(value as u128)
    }
}

impl From<i128> for Integer {
    #[inline]
    fn from(value: i128) -> Self {
        Integer::wide(value)
    }
}

impl From<u128> for Integer {
    #[inline]
    fn from(value: u128) -> Self {
        match i64::try_from(value) {
            Ok(value) => Integer::small(value),
            Err(_) => Integer(Large(backend::from_u128(value))),
        }
    }
}

impl Integer {
    /// The value as an `i64`, when it fits.
    #[inline]
    pub fn to_i64(&self) -> Option<i64> {
        match &self.0 {
            Small(value) => Some(*value),
            Large(_) => None,
        }
    }

    /// The value as a `u64`, when it fits.
    pub fn to_u64(&self) -> Option<u64> {
        match &self.0 {
            Small(value) => u64::try_from(*value).ok(),
            Large(value) => backend::to_u64(value),
        }
    }

    /// The value as an `i128`, when it fits.
    pub fn to_i128(&self) -> Option<i128> {
        match &self.0 {
            Small(value) => Some(i128::from(*value)),
            Large(value) => backend::to_i128(value),
        }
    }

    /// The magnitude in base 256, least significant byte first, without zero bytes at the end; empty for 0.
    pub fn magnitude_bytes_le(&self) -> Vec<u8> {
        match &self.0 {
            Small(value) => {
                let magnitude = value.unsigned_abs();
                let length = 8 - magnitude.leading_zeros() as usize / 8;
                magnitude.to_le_bytes()[..length].to_vec()
            }
            Large(value) => backend::magnitude_bytes_le(value),
        }
    }

    /// The number of the given magnitude in base 256, least significant byte first, negated when `negative`. Zero
    /// bytes at the end and a negated zero are taken in their numerical sense.
    pub fn from_magnitude_bytes_le(negative: bool, bytes: &[u8]) -> Integer {
        let magnitude = match bytes.len() {
            0..=8 => {
                let mut padded = [0; 8];
                padded[..bytes.len()].copy_from_slice(bytes);
                Integer::from(u64::from_le_bytes(padded))
            }
            _ => Integer::from_backend(backend::from_magnitude_bytes_le(bytes)),
        };
        if negative { -magnitude } else { magnitude }
    }

    /// The number that a text of decimal digits alone stands for.
    pub(crate) fn from_digits(digits: &str) -> Option<Integer> {
        if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
            return None;
        }
        match digits.parse() {
            Ok(value) => Some(Integer::small(value)),
            Err(_) => backend::parse(digits).map(Integer::from_backend),
        }
    }
}

impl FromStr for Integer {
    type Err = NumberError;

    /// Reads a canonical decimal: digits without a leading zero, after a '-' if the number is negative; nothing else,
    /// not even "-0" or "+1". The length is not bounded.
    ///
    /// # Errors
    /// [`NumberError::Empty`], [`NumberError::Unexpected`] and [`NumberError::NotCanonical`].
    fn from_str(text: &str) -> Result<Self, NumberError> {
        let digits = text.strip_prefix('-').unwrap_or(text);
        let Some(magnitude) = Integer::from_digits(digits) else {
            let offset = text.len() - digits.len();
            return Err(NumberError::not_digits(text, offset, text.len()));
        };
        if digits.len() > 1 && digits.starts_with('0') {
            return Err(NumberError::not_canonical(text, "a leading zero"));
        }
        if digits.len() == text.len() {
            Ok(magnitude)
        } else if magnitude.is_zero() {
            Err(NumberError::not_canonical(text, "a negative zero"))
        } else {
            Ok(-magnitude)
        }
    }
}

impl fmt::Display for Integer {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Small(value) => fmt::Display::fmt(value, formatter),
            Large(value) => fmt::Display::fmt(value, formatter),
        }
    }
}

impl fmt::Debug for Integer {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, formatter)
    }
}
