//! Rotations by rational numbers.

use crate::import::text::{abs, ratio, whole};
use crate::number::{Integer, Rational, RationalExt, approximate};

/// The greatest denominator of the tangent of half an angle.
const TANGENT_DENOMINATOR: u64 = 1 << 20;
/// Terms of the series of the arc tangent; its argument is at most tan 22.5° < 0.4143, so that the last is below 1e-19.
const TERMS: i64 = 24;

/// A rotation with rational cosine and sine, cos² + sin² = 1.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Rotation {
    pub(super) cosine: Rational,
    pub(super) sine: Rational,
    /// The angle differs by at most so much, in radians, from the one asked for; 0 for multiples of 90°.
    pub(super) error: Rational,
}

/// The rotation by an angle in degrees, exact for multiples of 90°, else by an angle near it.
pub(super) fn rotation(degrees: &Rational) -> Rotation {
    let quarters = (degrees / whole(90) + ratio(1, 2)).floor();
    // From −45° to 45°.
    let rest = degrees - &quarters * whole(90);
    let (mut cosine, mut sine) = (whole(1), whole(0));
    let mut error = whole(0);
    if !rest.numer().is_zero() {
        let size = abs(&rest);
        let guess = (size.to_f64() * std::f64::consts::PI / 360.0).tan();
        let tangent = approximate(guess, TANGENT_DENOMINATOR).unwrap_or_default();
        let square = &tangent * &tangent;
        cosine = (whole(1) - &square) / (whole(1) + &square);
        sine = whole(2) * &tangent / (whole(1) + &square);
        if rest.numer().is_negative() {
            sine = -sine;
        }
        error = angle_error(&tangent, &size);
    }
    let turn = &quarters - whole(4) * (&quarters / whole(4)).floor();
    for _ in 0..turn.numer().to_i64().unwrap_or(0) {
        (cosine, sine) = (-sine, cosine);
    }
    Rotation { cosine, sine, error }
}

/// An upper bound of |2 atan t − a π/180| for 0 ≤ t < 1/2.
fn angle_error(t: &Rational, degrees: &Rational) -> Rational {
    let square = t * t;
    let mut power = t.clone();
    let mut sum = whole(0);
    let mut before = whole(0);
    for k in 0..TERMS {
        before = sum.clone();
        let term = &power / whole(2 * k + 1);
        if k % 2 == 0 {
            sum += term;
        } else {
            sum -= term;
        }
        power *= &square;
    }
    // The terms alternate and decrease: the arc tangent lies between two partial sums. The last term is subtracted.
    let (lower, upper) = (whole(2) * sum, whole(2) * before);
    let (least, greatest) = pi();
    let angle = |pi: Rational| degrees * pi / whole(180);
    let above = abs(&(upper - angle(least)));
    let below = abs(&(angle(greatest) - lower));
    if above > below { above } else { below }
}

/// Fractions below and above π.
fn pi() -> (Rational, Rational) {
    let digits = Integer::from(314_159_265_358_979_323_i64);
    let unit = Integer::from(100_000_000_000_000_000_i64);
    (
        Rational::new(digits.clone(), unit.clone()),
        Rational::new(digits + Integer::ONE, unit),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarter_turns_are_exact() {
        for (degrees, cosine, sine) in [
            (0, 1, 0),
            (90, 0, 1),
            (180, -1, 0),
            (-90, 0, -1),
            (450, 0, 1),
            (-720, 1, 0),
        ] {
            let found = rotation(&whole(degrees));
            assert_eq!(found.cosine, whole(cosine), "{degrees}");
            assert_eq!(found.sine, whole(sine), "{degrees}");
            assert_eq!(found.error, whole(0));
        }
    }

    #[test]
    fn other_turns_are_rotations_with_a_true_bound() {
        for degrees in ["45", "-45", "30", "-123.4", "0.001", "359.999", "10000.5"] {
            let angle = crate::import::text::number(degrees, crate::number::Meaning::Decimal).unwrap();
            let found = rotation(&angle);
            assert_eq!(&found.cosine * &found.cosine + &found.sine * &found.sine, whole(1));
            assert!(
                found.error < ratio(1, 100_000_000_000),
                "{degrees}: {}",
                found.error.to_f64()
            );
            let radians = angle.to_f64().to_radians();
            // binary64 has errors of its own.
            let slack = found.error.to_f64() + 1e-12;
            assert!((found.cosine.to_f64() - radians.cos()).abs() < slack, "{degrees}");
            assert!((found.sine.to_f64() - radians.sin()).abs() < slack, "{degrees}");
        }
    }
}
