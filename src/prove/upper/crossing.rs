//! A planar curve that crosses itself, or a double point at simple fractions.

use super::round::{integer, power_of_two, rounded};
use super::{Bounds, UpperBound};
use crate::check::rule::crossing;
use crate::check::word::widening;
use crate::claim::msd::{Interval, Upper};
use crate::number::{Integer, Rational, RationalExt, approximate};
use crate::prove::newton::Location;
use crate::prove::vector::{dot, from_integers, quantised, scale, sub};

impl Bounds<'_> {
    /// A transversal self-crossing of a planar curve near two parameters, or a double point at simple fractions.
    pub fn crossing(&self, s: Location, t: Location) -> Option<UpperBound> {
        let (s, t) = self.intersect(s, t);
        let (a, b) = (approximate(s.1, 4096)?, approximate(t.1, 4096)?);
        if (a.to_f64() - s.1).abs() < 1e-9 && (b.to_f64() - t.1).abs() < 1e-9 {
            let (s, t) = (self.normal(integer(s.0) + a), self.normal(integer(t.0) + b));
            let found = self.exact_pair(&s, &t).filter(|found| found.squared.numer().is_zero());
            if found.is_some() {
                return found;
            }
        }
        if self.chain.dimension != 2 {
            return None;
        }
        let ([_, p1, _], [_, q1, _]) = (self.floats.evaluate(s.0, s.1), self.floats.evaluate(t.0, t.1));
        // n₁ is normal to c'(t) and grows with s; n₂ is normal to c'(s) and falls with t.
        let turn = |v: &[f64; 4], along: &[f64; 4]| {
            let n = [-v[1], v[0], 0.0, 0.0];
            scale(&n, dot(&n, along).signum())
        };
        let (first, second) = (turn(&q1, &p1), scale(&turn(&p1, &q1), -1.0));
        let (s, t) = (self.global(s)?, self.global(t)?);
        let (s, t, first, second) = if s <= t {
            (s, t, first, second)
        } else {
            (t, s, scale(&second, -1.0), scale(&first, -1.0))
        };
        for bits in [36u32, 28, 20, 12] {
            let interval = |x: &Rational| {
                let (middle, step) = (rounded(x, bits), power_of_two(bits));
                Interval {
                    start: &middle - &step,
                    end: middle + step,
                }
            };
            let (s, t) = (interval(&s), interval(&t));
            let (first, second) = (quantised(&first, 10), quantised(&second, 10));
            debug_assert!(from_integers(&first)[2] == 0.0);
            let (first, second) = (first.map(Integer::from), second.map(Integer::from));
            let outcome = widening!(64, W => crossing::check::<W>(self.chain, &s, &t, &first, &second));
            if outcome.is_ok() {
                let at = [(&s.start + &s.end) / integer(2), (&t.start + &t.end) / integer(2)];
                let rule = Upper::Crossing { s, t, first, second };
                return Some(UpperBound {
                    rule,
                    squared: integer(0),
                    at,
                });
            }
        }
        None
    }

    /// Newton's method for c(s) = c(t), in the least-squares sense.
    fn intersect(&self, s: Location, t: Location) -> (Location, Location) {
        let (mut s, mut t) = (s, t);
        for _ in 0..12 {
            let ([p, p1, _], [q, q1, _]) = (self.floats.evaluate(s.0, s.1), self.floats.evaluate(t.0, t.1));
            let x = sub(&p, &q);
            let (a, b, c) = (dot(&p1, &p1), -dot(&p1, &q1), dot(&q1, &q1));
            let (f, g) = (-dot(&x, &p1), dot(&x, &q1));
            let determinant = a * c - b * b;
            let (ds, dt) = ((f * c - g * b) / determinant, (a * g - b * f) / determinant);
            if !ds.is_finite() || !dt.is_finite() {
                break;
            }
            s.1 = (s.1 + ds).clamp(0.0, 1.0);
            t.1 = (t.1 + dt).clamp(0.0, 1.0);
        }
        (s, t)
    }
}
