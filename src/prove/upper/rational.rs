//! Double normals at simple fractions, found exactly.

use super::round::{integer, power_of_two};
use super::{Bounds, UpperBound};
use crate::check::rule::{critical, root};
use crate::check::section::locate;
use crate::claim::msd::{Convention, Side, Upper};
use crate::number::{Rational, RationalExt, approximate, simplest_between};
use crate::prove::newton::{self, Candidate, Location};

impl Bounds<'_> {
    /// A root at simple fractions near the candidate.
    pub fn rational_root(&self, candidate: &Candidate) -> Option<UpperBound> {
        let simple = |location: Location| {
            let u = approximate(location.1, 64)?;
            ((u.to_f64() - location.1).abs() < 1e-9).then(|| self.normal(integer(location.0) + u))
        };
        if let (Some(s), Some(t)) = (simple(candidate.s), simple(candidate.t)) {
            let found = self.exact_pair(&s, &t);
            if found.is_some() {
                return found;
            }
        }
        // In a continuum of double normals one end can be chosen; the other is its foot.
        let continuum = self.singular(candidate);
        if !continuum {
            return None;
        }
        for (free, other) in [(candidate.s, candidate.t), (candidate.t, candidate.s)] {
            let simple =
                [1.0, 2.0, 4.0, 8.0].map(|denominator| ((free.1 * denominator).round() / denominator).clamp(0.0, 1.0));
            for fixed in simple.into_iter().chain([free.1]) {
                let [p, _, _] = self.floats.evaluate(free.0, fixed);
                let found = newton::foot(self.floats, &p, other).and_then(|foot| {
                    let fixed = self.normal(integer(free.0) + Rational::from_f64(fixed)?);
                    self.exact_pair(&fixed, &self.exact_foot(&fixed, foot)?)
                });
                if found.is_some() {
                    return found;
                }
            }
        }
        None
    }

    /// A fraction near `foot` at which a perpendicular from c(s) may meet the curve exactly: the simplest one near the root of the
    /// equation, if it is much simpler than the accuracy of the root. On a segment and on a conic whose normals pass through one point such fractions exist.
    pub(super) fn exact_foot(&self, s: &Rational, foot: Location) -> Option<Rational> {
        if let Some(u) = approximate(foot.1, 1 << 20)
            && (u.to_f64() - foot.1).abs() < 1e-13
        {
            return Some(self.normal(integer(foot.0) + u));
        }
        let start = integer(foot.0) + Rational::from_f64(foot.1)?;
        [128, 640].into_iter().find_map(|bits| {
            let root = self.refined_foot(s, start.clone(), bits)?;
            let error = power_of_two(bits - 4);
            let simplest = simplest_between(&(&root - &error), &(&root + &error));
            (simplest.denom().bits() < u64::from(bits) / 2 - 8).then(|| self.normal(simplest))
        })
    }

    /// Is the Jacobian at the candidate nearly singular?
    fn singular(&self, candidate: &Candidate) -> bool {
        let [[a, b], [c, d]] = self.jacobian(candidate.s, candidate.t);
        (a * d - b * c).abs() < 1e-5 * (a * a + b * b + c * c + d * d)
    }

    /// Exact evidence at two exact parameters.
    pub(super) fn exact_pair(&self, s: &Rational, t: &Rational) -> Option<UpperBound> {
        let (s, t) = if s <= t { (s, t) } else { (t, s) };
        if s == t {
            return None;
        }
        let sides = |parameter: &Rational| -> Vec<Side> {
            let both = [Side::After, Side::Before];
            let there = both
                .into_iter()
                .filter(|side| locate(self.chain, parameter, *side).is_some());
            there.take(if parameter.is_integer() { 2 } else { 1 }).collect()
        };
        let bound = |rule, squared| {
            Some(UpperBound {
                rule,
                squared,
                at: [s.clone(), t.clone()],
            })
        };
        for side_s in sides(s) {
            for side_t in sides(t) {
                let (x, unit) = root::chord(self.chain, (s, side_s), (t, side_t))?;
                let squared = Rational::new(root::product(&x, &x), &unit * &unit);
                if squared.numer().is_zero() {
                    return bound(
                        Upper::Touch {
                            s: s.clone(),
                            t: t.clone(),
                        },
                        squared,
                    );
                }
                let (at_s, at_t) = ((s.clone(), side_s), (t.clone(), side_t));
                if root::check(self.chain, &at_s, &at_t, &squared).is_ok() {
                    return bound(Upper::Root { s: at_s, t: at_t }, squared);
                }
                if self.convention == Convention::Critical && critical::check_root(self.chain, s, t, &squared).is_ok() {
                    return bound(
                        Upper::CriticalRoot {
                            s: s.clone(),
                            t: t.clone(),
                        },
                        squared,
                    );
                }
            }
        }
        None
    }
}
