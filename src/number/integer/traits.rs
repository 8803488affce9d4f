//! The numeric traits that [`num_rational::Ratio`] asks of its integers.

use num_traits::{Num, One, Signed, Zero};

use super::Integer;
use crate::number::NumberError;

impl Zero for Integer {
    #[inline]
    fn zero() -> Self {
        Integer::ZERO
    }

    #[inline]
    fn is_zero(&self) -> bool {
        Integer::is_zero(self)
    }
}

impl One for Integer {
    #[inline]
    fn one() -> Self {
        Integer::ONE
    }

    #[inline]
    fn is_one(&self) -> bool {
        Integer::is_one(self)
    }
}

impl Num for Integer {
    type FromStrRadixErr = NumberError;

    /// Reads an integer of the given radix, 2 to 36: digits of either case after an optional '-'. Radix 10 is
    /// canonical decimal, as in [`str::parse`]; any other takes time quadratic in the length.
    ///
    /// # Errors
    /// As [`str::parse`]; [`NumberError::Unexpected`] for what is no digit, and for every text if the radix is outside
    /// 2 to 36.
    fn from_str_radix(text: &str, radix: u32) -> Result<Self, NumberError> {
        if radix == 10 {
            return text.parse();
        }
        let digits = text.strip_prefix('-').unwrap_or(text);
        if digits.is_empty() {
            return Err(NumberError::not_digits(text, text.len(), text.len()));
        }
        let base = Integer::from(radix);
        let mut magnitude = Integer::ZERO;
        for (offset, character) in digits.char_indices() {
            let digit = if (2..=36).contains(&radix) {
                character.to_digit(radix)
            } else {
                None
            };
            let Some(digit) = digit else {
                let offset = text.len() - digits.len() + offset;
                return Err(NumberError::unexpected(text, offset));
            };
            magnitude = magnitude * &base + Integer::from(digit);
        }
        Ok(if digits.len() < text.len() {
            -magnitude
        } else {
            magnitude
        })
    }
}

impl Signed for Integer {
    fn abs(&self) -> Self {
        Integer::abs(self)
    }

    /// self − other, or 0 if that is negative.
    fn abs_sub(&self, other: &Self) -> Self {
        if self <= other { Integer::ZERO } else { self - other }
    }

    fn signum(&self) -> Self {
        Integer::small(self.sign() as i64)
    }

    fn is_positive(&self) -> bool {
        Integer::is_positive(self)
    }

    fn is_negative(&self) -> bool {
        Integer::is_negative(self)
    }
}

impl num_integer::Integer for Integer {
    fn div_floor(&self, other: &Self) -> Self {
        Integer::div_floor(self, other)
    }

    fn mod_floor(&self, other: &Self) -> Self {
        let remainder = self % other;
        if !remainder.is_zero() && remainder.is_negative() != other.is_negative() {
            remainder + other
        } else {
            remainder
        }
    }

    fn div_ceil(&self, other: &Self) -> Self {
        Integer::div_ceil(self, other)
    }

    #[inline]
    fn gcd(&self, other: &Self) -> Self {
        Integer::gcd(self, other)
    }

    fn lcm(&self, other: &Self) -> Self {
        Integer::lcm(self, other)
    }

    fn is_multiple_of(&self, other: &Self) -> bool {
        if other.is_zero() {
            self.is_zero()
        } else {
            (self % other).is_zero()
        }
    }

    fn is_even(&self) -> bool {
        self.trailing_zeros() != Some(0)
    }

    fn is_odd(&self) -> bool {
        self.trailing_zeros() == Some(0)
    }

    fn div_rem(&self, other: &Self) -> (Self, Self) {
        Integer::div_rem(self, other)
    }
}
