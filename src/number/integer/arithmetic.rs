//! Sums, differences, products and shifts, for owned and borrowed operands alike.

use std::iter::Sum;
use std::ops::{Add, AddAssign, Mul, MulAssign, Neg, Shl, ShlAssign, Shr, ShrAssign, Sub, SubAssign};

use super::{Integer, Large, Small, backend};

impl Integer {
    #[inline]
    fn add_in_place(&mut self, other: &Integer) {
        match (&mut self.0, &other.0) {
            (Small(a), Small(b)) => match a.checked_add(*b) {
                Some(sum) => *a = sum,
                None => *self = Integer::wide(i128::from(*a) + i128::from(*b)),
            },
            (Large(a), Small(b)) => {
                backend::add_small(a, *b);
                self.shrink();
            }
            (Large(a), Large(b)) => {
                backend::add_assign(a, b);
                self.shrink();
            }
            (Small(a), Large(b)) => {
                let mut sum = b.clone();
                backend::add_small(&mut sum, *a);
                *self = Integer::from_backend(sum);
            }
        }
    }

    #[inline]
    fn sub_in_place(&mut self, other: &Integer) {
        match (&mut self.0, &other.0) {
            (Small(a), Small(b)) => match a.checked_sub(*b) {
                Some(difference) => *a = difference,
                None => *self = Integer::wide(i128::from(*a) - i128::from(*b)),
            },
            (Large(a), Small(b)) => {
                backend::sub_small(a, *b);
                self.shrink();
            }
            (Large(a), Large(b)) => {
                backend::sub_assign(a, b);
                self.shrink();
            }
            (Small(a), Large(b)) => {
                let mut negated = b.clone();
                backend::sub_small(&mut negated, *a);
                *self = Integer::from_backend(backend::neg(negated));
            }
        }
    }

    #[inline]
    fn mul_in_place(&mut self, other: &Integer) {
        match (&mut self.0, &other.0) {
            (Small(a), Small(b)) => match a.checked_mul(*b) {
                Some(product) => *a = product,
                None => *self = Integer::wide(i128::from(*a) * i128::from(*b)),
            },
            (Large(a), Small(b)) => {
                backend::mul_small(a, *b);
                self.shrink();
            }
            (Large(a), Large(b)) => {
                backend::mul_assign(a, b);
                self.shrink();
            }
            (Small(a), Large(b)) => {
                let mut product = b.clone();
                backend::mul_small(&mut product, *a);
                *self = Integer::from_backend(product);
            }
        }
    }

    #[inline]
    fn add_borrowed(&self, other: &Integer) -> Integer {
        match (&self.0, &other.0) {
            (Small(a), Small(b)) => match a.checked_add(*b) {
                Some(sum) => Integer::small(sum),
                None => Integer::wide(i128::from(*a) + i128::from(*b)),
            },
            (Large(a), Large(b)) => Integer::from_backend(backend::add(a, b)),
            _ => {
                let mut sum = self.clone();
                sum.add_in_place(other);
                sum
            }
        }
    }

    #[inline]
    fn sub_borrowed(&self, other: &Integer) -> Integer {
        match (&self.0, &other.0) {
            (Small(a), Small(b)) => match a.checked_sub(*b) {
                Some(difference) => Integer::small(difference),
                None => Integer::wide(i128::from(*a) - i128::from(*b)),
            },
            (Large(a), Large(b)) => Integer::from_backend(backend::sub(a, b)),
            _ => {
                let mut difference = self.clone();
                difference.sub_in_place(other);
                difference
            }
        }
    }

    #[inline]
    fn mul_borrowed(&self, other: &Integer) -> Integer {
        match (&self.0, &other.0) {
            (Small(a), Small(b)) => match a.checked_mul(*b) {
                Some(product) => Integer::small(product),
                None => Integer::wide(i128::from(*a) * i128::from(*b)),
            },
            (Large(a), Large(b)) => Integer::from_backend(backend::mul(a, b)),
            _ => {
                let mut product = self.clone();
                product.mul_in_place(other);
                product
            }
        }
    }
}

/// The four owned and borrowed forms of an operator and its two assigning forms, from one function on references and
/// one in place. The third form takes the right operand's storage, where the operator commutes.
macro_rules! operator {
    ($trait:ident $method:ident, $assign_trait:ident $assign:ident, $borrowed:ident, $in_place:ident, $third:expr) => {
        impl $trait<&Integer> for &Integer {
            type Output = Integer;
            #[inline]
            fn $method(self, other: &Integer) -> Integer {
                self.$borrowed(other)
            }
        }

        impl $trait<&Integer> for Integer {
            type Output = Integer;
            #[inline]
            fn $method(mut self, other: &Integer) -> Integer {
                self.$in_place(other);
                self
            }
        }

        impl $trait<Integer> for &Integer {
            type Output = Integer;
            #[inline]
            fn $method(self, other: Integer) -> Integer {
                let third: fn(&Integer, Integer) -> Integer = $third;
                third(self, other)
            }
        }

        impl $trait<Integer> for Integer {
            type Output = Integer;
            #[inline]
            fn $method(mut self, other: Integer) -> Integer {
                self.$in_place(&other);
                self
            }
        }

        impl $assign_trait<&Integer> for Integer {
            #[inline]
            fn $assign(&mut self, other: &Integer) {
                self.$in_place(other);
            }
        }

        impl $assign_trait<Integer> for Integer {
            #[inline]
            fn $assign(&mut self, other: Integer) {
                self.$in_place(&other);
            }
        }
    };
}
pub(super) use operator;

operator!(Add add, AddAssign add_assign, add_borrowed, add_in_place, |a, mut b| {
    b.add_in_place(a);
    b
});
operator!(Sub sub, SubAssign sub_assign, sub_borrowed, sub_in_place, |a, b| a.sub_borrowed(&b));
operator!(Mul mul, MulAssign mul_assign, mul_borrowed, mul_in_place, |a, mut b| {
    b.mul_in_place(a);
    b
});

impl Neg for Integer {
    type Output = Integer;
    #[inline]
    fn neg(self) -> Integer {
        match self.0 {
            Small(value) => Integer::wide(-i128::from(value)),
            Large(value) => Integer::from_backend(backend::neg(value)),
        }
    }
}

impl Neg for &Integer {
    type Output = Integer;
    #[inline]
    fn neg(self) -> Integer {
        -self.clone()
    }
}

impl Shl<u32> for &Integer {
    type Output = Integer;
    /// self · 2^bits.
    #[inline]
    fn shl(self, bits: u32) -> Integer {
        match &self.0 {
            Small(0) => Integer::ZERO,
            Small(value) => {
                if bits < 64 && (value << bits) >> bits == *value {
                    Integer::small(value << bits)
                } else if bits < 64 {
                    Integer::wide(i128::from(*value) << bits)
                } else {
                    Integer::from_backend(backend::shl(&self.to_backend(), bits))
                }
            }
            Large(value) => Integer::from_backend(backend::shl(value, bits)),
        }
    }
}

impl Shr<u32> for &Integer {
    type Output = Integer;
    /// ⌊self / 2^bits⌋.
    #[inline]
    fn shr(self, bits: u32) -> Integer {
        match &self.0 {
            Small(value) => Integer::small(value >> bits.min(63)),
            Large(value) => Integer::from_backend(backend::shr(value, bits)),
        }
    }
}

impl Shl<u32> for Integer {
    type Output = Integer;
    /// self · 2^bits.
    #[inline]
    fn shl(self, bits: u32) -> Integer {
        &self << bits
    }
}

impl Shr<u32> for Integer {
    type Output = Integer;
    /// ⌊self / 2^bits⌋.
    #[inline]
    fn shr(self, bits: u32) -> Integer {
        &self >> bits
    }
}

impl ShlAssign<u32> for Integer {
    #[inline]
    fn shl_assign(&mut self, bits: u32) {
        *self = &*self << bits;
    }
}

impl ShrAssign<u32> for Integer {
    #[inline]
    fn shr_assign(&mut self, bits: u32) {
        *self = &*self >> bits;
    }
}

impl Sum for Integer {
    fn sum<I: Iterator<Item = Integer>>(numbers: I) -> Integer {
        numbers.fold(Integer::ZERO, |sum, number| sum + number)
    }
}

impl<'a> Sum<&'a Integer> for Integer {
    fn sum<I: Iterator<Item = &'a Integer>>(numbers: I) -> Integer {
        numbers.fold(Integer::ZERO, |sum, number| sum + number)
    }
}
