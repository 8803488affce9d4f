//! `root` and `touch`: a double normal, or a double point, at exact parameters (FORMAT §6).
//!
//! Proof: the products are computed, not estimated. The parameters differ, because s < t and M is not used on a closed curve.

use super::{Outcome, fails};
use crate::check::chain::Chain;
use crate::check::section::{direction, is_parameter, locate, point};
use crate::check::word::{Word, dot};
use crate::claim::msd::Side;
use crate::number::{Integer, Rational};

/// The chord between two parameters: an integer vector over a positive integer. `None` for a parameter that does not exist.
pub fn chord(chain: &Chain, s: (&Rational, Side), t: (&Rational, Side)) -> Option<([Integer; 3], Integer)> {
    let at = |(parameter, side)| {
        let here =
            point::<Integer>(chain, &locate(chain, parameter, side)?).expect("unbounded integers do not overflow");
        let hull = here.hull();
        let (x, weight) = hull.points().next().expect("a point");
        let weight = weight
            .cloned()
            .unwrap_or_else(|| hull.shared_scale().expect("one weight").value());
        Some((x.clone(), weight))
    };
    let ((p, w), (q, v)) = (at(s)?, at(t)?);
    Some(([0, 1, 2].map(|i| &p[i] * &v - &q[i] * &w), w * v))
}

/// Two parameters of the curve, in order.
pub fn ordered(chain: &Chain, s: &Rational, t: &Rational) -> Outcome {
    if !is_parameter(chain, s) || !is_parameter(chain, t) {
        return fails("two parameters of the curve", format!("{s}, {t}"));
    }
    if s >= t {
        fails("s < t", format!("{s}, {t}"))
    } else {
        Ok(())
    }
}

/// Is the chord x/u at most √upper_squared long?
pub fn at_most(x: &[Integer; 3], unit: &Integer, upper_squared: &Rational) -> Outcome {
    let square = Rational::new(product(x, x), unit * unit);
    if square <= *upper_squared {
        Ok(())
    } else {
        fails("upper_squared ≥ |chord|²", format!("|chord|² = {square}"))
    }
}

/// The dot product.
pub fn product(a: &[Integer; 3], b: &[Integer; 3]) -> Integer {
    dot(a, b).expect("unbounded integers do not overflow")
}

/// Checks `root`.
pub fn check(chain: &Chain, s: &(Rational, Side), t: &(Rational, Side), upper_squared: &Rational) -> Outcome {
    ordered(chain, &s.0, &t.0)?;
    if [s, t]
        .into_iter()
        .any(|(parameter, side)| *side == Side::Before && !parameter.is_integer())
    {
        return fails(
            "the side \"after\" of a parameter that is not an integer",
            "\"before\"".into(),
        );
    }
    let Some((x, unit)) = chord(chain, (&s.0, s.1), (&t.0, t.1)) else {
        return fails("a piece on the side named", "none".into());
    };
    for (parameter, side) in [s, t] {
        let location = locate(chain, parameter, *side).expect("located for the chord");
        let Some(v) = direction(chain, &location) else {
            return fails("a tangent direction", format!("the derivative vanishes at {parameter}"));
        };
        let along = product(&x, &v);
        if !along.vanishes() {
            return fails(
                "a chord orthogonal to the tangent",
                format!("a product of sign {:?} at {parameter}", along.sign()),
            );
        }
    }
    at_most(&x, &unit, upper_squared)
}

/// Checks `touch`.
pub fn check_touch(chain: &Chain, s: &Rational, t: &Rational) -> Outcome {
    ordered(chain, s, t)?;
    // On an open curve the parameter M has no piece after it.
    let side = |parameter: &Rational| {
        if locate(chain, parameter, Side::After).is_some() {
            Side::After
        } else {
            Side::Before
        }
    };
    match chord(chain, (s, side(s)), (t, side(t))) {
        Some((x, _)) if x.iter().all(Word::vanishes) => Ok(()),
        _ => fails("c(s) = c(t)", "different points".into()),
    }
}
