//! Square roots of fractions, enclosed.

use super::{Integer, Rational};

/// Two fractions (lower, upper) with lower ≤ √x ≤ upper.
///
/// When x is the square of a fraction both are that fraction. Otherwise both are dyadic, lower < √x < upper, and
/// upper − lower ≤ 2^-bits · √x.
///
/// # Panics
/// When x is negative.
///
/// ```
/// use knotproof::number::{Integer, Rational, sqrt_enclosure};
/// let two = Rational::from_integer(Integer::from(2));
/// let (lower, upper) = sqrt_enclosure(&two, 53);
/// assert!(&lower * &lower < two && two < &upper * &upper);
/// ```
pub fn sqrt_enclosure(x: &Rational, bits: u32) -> (Rational, Rational) {
    assert!(!x.numer().is_negative(), "square root of a negative number");
    if let Some(root) = exact_sqrt(x) {
        return (root.clone(), root);
    }
    // √x > 2^(decade), so a spacing of 2^(decade - bits) is narrow enough.
    let decade = (x.numer().bits() as i64 - x.denom().bits() as i64 - 1).div_euclid(2);
    let exponent = i64::from(bits) - decade;
    let shift = u32::try_from(2 * exponent.unsigned_abs()).expect("more bits than memory holds");
    let scaled = if exponent >= 0 {
        (x.numer() << shift).div_floor(x.denom())
    } else {
        x.numer().div_floor(&(x.denom() << shift))
    };
    // ⌊√⌊y⌋⌋ = ⌊√y⌋, and √y is no integer here.
    let root = scaled.sqrt_floor().unwrap_or_default();
    let next = &root + Integer::ONE;
    (scale(root, -exponent), scale(next, -exponent))
}

/// √x when it is a fraction; `None` for other and for negative numbers.
pub fn exact_sqrt(x: &Rational) -> Option<Rational> {
    let root = |square: &Integer| {
        let root = square.sqrt_floor()?;
        (&root * &root == *square).then_some(root)
    };
    // In a reduced square fraction both parts are squares.
    Some(Rational::new_raw(root(x.numer())?, root(x.denom())?))
}

/// value · 2^exponent.
fn scale(value: Integer, exponent: i64) -> Rational {
    let shift = exponent.unsigned_abs() as u32;
    if exponent >= 0 {
        Rational::from_integer(value << shift)
    } else {
        Rational::new(value, Integer::ONE << shift)
    }
}
