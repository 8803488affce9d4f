//! The integers the checker computes with: four widths, one interface.
//!
//! Every operation is checked. `None` means "does not fit", never a wrapped value, and the caller repeats the whole test in
//! the next width; in the last one, [`Integer`], everything fits. So a width is a matter of speed alone.

use std::borrow::Cow;
use std::cmp::Ordering;

use ethnum::I256;

use super::chain::convert;

use crate::number::Integer;

/// An integer type of some width, with checked arithmetic.
pub trait Word: Clone + Ord {
    /// The number zero.
    fn zero() -> Self;
    /// `value`, or `None` if it does not fit.
    fn from_i128(value: i128) -> Option<Self>;
    /// `value`, or `None` if it does not fit.
    fn from_integer(value: &Integer) -> Option<Self>;
    /// The same number as an [`Integer`].
    fn to_integer(&self) -> Integer;
    /// The same number, or `None` if it does not fit.
    fn to_i128(&self) -> Option<i128>;
    /// `self + other`.
    fn plus(&self, other: &Self) -> Option<Self>;
    /// `self − other`.
    fn minus(&self, other: &Self) -> Option<Self>;
    /// `self · other`.
    fn times(&self, other: &Self) -> Option<Self>;
    /// `self · 2^bits`.
    fn doubled(&self, bits: u32) -> Option<Self>;
    /// The bit length of the magnitude.
    fn bit_length(&self) -> u32;

    /// Vectors of 64-bit integers in this width, borrowed where it is the same.
    fn of_narrow(vectors: &[[i64; 3]]) -> Option<Cow<'_, [[Self; 3]]>> {
        vectors.iter().map(convert).collect::<Option<_>>().map(Cow::Owned)
    }
    /// Vectors of 128-bit integers in this width, borrowed where it is the same.
    fn of_wide(vectors: &[[i128; 3]]) -> Option<Cow<'_, [[Self; 3]]>> {
        vectors.iter().map(convert).collect::<Option<_>>().map(Cow::Owned)
    }
    /// Vectors of integers of any size in this width, borrowed where it is the same.
    fn of_large(vectors: &[[Integer; 3]]) -> Option<Cow<'_, [[Self; 3]]>> {
        vectors.iter().map(vector).collect::<Option<_>>().map(Cow::Owned)
    }

    /// The order of `self` and zero.
    #[inline]
    fn sign(&self) -> Ordering {
        self.cmp(&Self::zero())
    }
    /// Is `self` zero?
    #[inline]
    fn vanishes(&self) -> bool {
        self.sign() == Ordering::Equal
    }
}

macro_rules! machine_word {
    ($type:ty, $borrowed:ident, $times:expr) => {
        impl Word for $type {
            #[inline]
            fn $borrowed(vectors: &[[Self; 3]]) -> Option<Cow<'_, [[Self; 3]]>> {
                Some(Cow::Borrowed(vectors))
            }
            #[inline]
            fn zero() -> Self {
                0
            }
            #[inline]
            fn from_i128(value: i128) -> Option<Self> {
                <$type>::try_from(value).ok()
            }
            #[inline]
            fn from_integer(value: &Integer) -> Option<Self> {
                match value.to_i64() {
                    Some(small) => Some(<$type>::from(small)),
                    None => value.to_i128().and_then(|wide| <$type>::try_from(wide).ok()),
                }
            }
            fn to_integer(&self) -> Integer {
                Integer::from(*self)
            }
            #[inline]
            fn to_i128(&self) -> Option<i128> {
                Some(i128::from(*self))
            }
            #[inline]
            fn plus(&self, other: &Self) -> Option<Self> {
                self.checked_add(*other)
            }
            #[inline]
            fn minus(&self, other: &Self) -> Option<Self> {
                self.checked_sub(*other)
            }
            #[inline]
            fn times(&self, other: &Self) -> Option<Self> {
                $times(*self, *other)
            }
            #[inline]
            fn doubled(&self, bits: u32) -> Option<Self> {
                if bits == 0 || *self == 0 {
                    return Some(*self);
                }
                // A shift is the product with 2^bits, which is checked by shifting back.
                let shifted = self.checked_shl(bits)?;
                (shifted >> bits == *self).then_some(shifted)
            }
            #[inline]
            fn bit_length(&self) -> u32 {
                <$type>::BITS - self.unsigned_abs().leading_zeros()
            }
        }
    };
}

machine_word!(i64, of_narrow, i64::checked_mul);
machine_word!(i128, of_wide, checked_product);

/// The product of two 128-bit integers. Mostly both have at most 64 bits, and then it always fits: its magnitude is at most 2^126.
#[inline]
fn checked_product(a: i128, b: i128) -> Option<i128> {
    match (i64::try_from(a), i64::try_from(b)) {
        (Ok(a), Ok(b)) => Some(i128::from(a) * i128::from(b)),
        _ => a.checked_mul(b),
    }
}

/// The product of two 128-bit integers, which always fits: its magnitude is at most 2^254.
#[inline]
fn full_product(a: i128, b: i128) -> I256 {
    const LOW: u128 = u64::MAX as u128;
    let (x, y) = (a.unsigned_abs(), b.unsigned_abs());
    let (x1, x0, y1, y0) = (x >> 64, x & LOW, y >> 64, y & LOW);
    // Four products of 64 bits each; the middle sum is below 3·2^64.
    let low = x0 * y0;
    let cross = x1 * y0;
    let middle = (low >> 64) + (cross & LOW) + ((x0 * y1) & LOW);
    let high = x1 * y1 + (cross >> 64) + ((x0 * y1) >> 64) + (middle >> 64);
    let magnitude = I256::from_words(high as i128, ((middle << 64) | (low & LOW)) as i128);
    if (a < 0) == (b < 0) { magnitude } else { -magnitude }
}

impl Word for I256 {
    #[inline]
    fn zero() -> Self {
        I256::ZERO
    }
    #[inline]
    fn from_i128(value: i128) -> Option<Self> {
        Some(I256::from(value))
    }
    fn from_integer(value: &Integer) -> Option<Self> {
        if let Some(small) = value.to_i128() {
            return Some(I256::from(small));
        }
        if value.bits() > 254 {
            return None;
        }
        let low_part = value - ((value >> 127u32) << 127u32);
        let high = I256::from((value >> 127u32).to_i128()?);
        high.checked_mul(I256::ONE << 127u32)?
            .checked_add(I256::from(low_part.to_i128()?))
    }
    fn to_integer(&self) -> Integer {
        let (high, low) = self.into_words();
        (Integer::from(high) << 128u32) + Integer::from(low as u128)
    }
    #[inline]
    fn to_i128(&self) -> Option<i128> {
        i128::try_from(*self).ok()
    }
    #[inline]
    fn plus(&self, other: &Self) -> Option<Self> {
        self.checked_add(*other)
    }
    #[inline]
    fn minus(&self, other: &Self) -> Option<Self> {
        self.checked_sub(*other)
    }
    #[inline]
    fn times(&self, other: &Self) -> Option<Self> {
        match (i128::try_from(*self), i128::try_from(*other)) {
            (Ok(a), Ok(b)) => Some(full_product(a, b)),
            _ => self.checked_mul(*other),
        }
    }
    #[inline]
    fn doubled(&self, bits: u32) -> Option<Self> {
        if bits == 0 || *self == I256::ZERO {
            return Some(*self);
        }
        let shifted = self.checked_shl(bits)?;
        (shifted >> bits == *self).then_some(shifted)
    }
    #[inline]
    fn bit_length(&self) -> u32 {
        256 - self.unsigned_abs().leading_zeros()
    }
}

impl Word for Integer {
    fn of_large(vectors: &[[Integer; 3]]) -> Option<Cow<'_, [[Self; 3]]>> {
        Some(Cow::Borrowed(vectors))
    }
    fn zero() -> Self {
        Integer::from(0i64)
    }
    fn from_i128(value: i128) -> Option<Self> {
        Some(Integer::from(value))
    }
    fn from_integer(value: &Integer) -> Option<Self> {
        Some(value.clone())
    }
    fn to_integer(&self) -> Integer {
        self.clone()
    }
    fn to_i128(&self) -> Option<i128> {
        Integer::to_i128(self)
    }
    fn plus(&self, other: &Self) -> Option<Self> {
        Some(self + other)
    }
    fn minus(&self, other: &Self) -> Option<Self> {
        Some(self - other)
    }
    fn times(&self, other: &Self) -> Option<Self> {
        Some(self * other)
    }
    fn doubled(&self, bits: u32) -> Option<Self> {
        Some(self << bits)
    }
    fn bit_length(&self) -> u32 {
        u32::try_from(self.bits()).unwrap_or(u32::MAX)
    }
}

/// Evaluates an expression that is generic over a [`Word`] (named `$word` in it) and yields `None` on overflow, in the
/// narrowest width that may hold `$bits` bits and then in wider ones until it succeeds.
macro_rules! widening {
    ($bits:expr, $word:ident => $test:expr) => {{
        let bits: u32 = $bits;
        let mut outcome = None;
        if bits <= 62 {
            type $word = i64;
            outcome = $test;
        }
        if outcome.is_none() && bits <= 126 {
            type $word = i128;
            outcome = $test;
        }
        if outcome.is_none() && bits <= 254 {
            type $word = ::ethnum::I256;
            outcome = $test;
        }
        match outcome {
            Some(outcome) => outcome,
            None => {
                type $word = $crate::number::Integer;
                $test.expect("unbounded integers do not overflow")
            }
        }
    }};
}
pub(crate) use widening;

/// The dot product of two vectors of three.
#[inline]
pub fn dot<W: Word>(a: &[W; 3], b: &[W; 3]) -> Option<W> {
    a[0].times(&b[0])?.plus(&a[1].times(&b[1])?)?.plus(&a[2].times(&b[2])?)
}

/// `a·x + b·y` of two vectors of three.
#[inline]
pub fn combine<W: Word>(a: &W, x: &[W; 3], b: &W, y: &[W; 3]) -> Option<[W; 3]> {
    let axis = |i: usize| a.times(&x[i])?.plus(&b.times(&y[i])?);
    Some([axis(0)?, axis(1)?, axis(2)?])
}

/// A vector of three integers in this width.
pub fn vector<W: Word>(v: &[Integer; 3]) -> Option<[W; 3]> {
    Some([
        W::from_integer(&v[0])?,
        W::from_integer(&v[1])?,
        W::from_integer(&v[2])?,
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shifts_never_wrap() {
        assert_eq!(1i64.doubled(62), Some(1 << 62));
        assert_eq!(1i64.doubled(63), None);
        assert_eq!((-1i64).doubled(63), Some(i64::MIN));
        assert_eq!(1i64.doubled(64), None);
        assert_eq!(3i128.doubled(126), None);
        assert_eq!(I256::from(1i128).doubled(255), None);
        assert_eq!(I256::from(1i128).doubled(300), None);
    }

    #[test]
    fn integers_convert_at_the_borders() {
        for bits in [62u32, 63, 64, 126, 127, 128, 200, 253] {
            for offset in [-1i64, 0, 1] {
                for sign in [1i64, -1] {
                    let value = ((Integer::from(1i64) << bits) + Integer::from(offset)) * Integer::from(sign);
                    let word = I256::from_integer(&value).expect("fits in 256 bits");
                    assert_eq!(word.to_integer(), value);
                    assert_eq!(i128::from_integer(&value).is_some(), value.to_i128().is_some());
                    assert_eq!(i64::from_integer(&value).is_some(), value.to_i64().is_some());
                }
            }
        }
    }

    proptest::proptest! {
        #[test]
        fn products_of_128_bits(a: i128, b: i128, shift in 0u32..127, other in 0u32..127) {
            for (a, b) in [(a >> shift, b >> other), (a, i128::MIN), (i128::MIN, i128::MIN), (i128::MAX, b), (-1, b)] {
                let product = I256::from(a).times(&I256::from(b)).expect("fits");
                proptest::prop_assert_eq!(product.to_integer(), Integer::from(a) * Integer::from(b));
            }
        }
    }

    #[test]
    fn overflow_widens() {
        let big = i64::MAX;
        let square = widening!(10, W => (|| {
            let x = W::from_i128(i128::from(big))?;
            Some(x.times(&x)?.to_integer())
        })());
        assert_eq!(square, Integer::from(i128::from(big) * i128::from(big)));
    }
}
