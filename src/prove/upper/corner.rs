//! A critical chord from a corner or an end to the inside of a piece.

use super::miranda::farther;
use super::round::{few_bits_between, integer, power_of_two, rounded};
use super::{Bounds, UpperBound};
use crate::check::rule::{critical, root};
use crate::check::section::{Section, as_joint, joint_pieces, locate, point, section, sections, smooth_at};
use crate::check::word::widening;
use crate::claim::msd::{Convention, Interval, Upper};
use crate::number::{Integer, Rational, RationalExt};
use crate::prove::newton::{Candidate, Location};
use crate::prove::vector::{dot, sub};

impl Bounds<'_> {
    /// A critical chord from a corner or an end to the inside of a piece.
    pub(super) fn critical_interval(&self, candidate: &Candidate, relative_width: &Rational) -> Option<UpperBound> {
        if self.convention != Convention::Critical {
            return None;
        }
        let corner_at = |location: Location| {
            let nearest = location.1.round();
            if (location.1 - nearest).abs() > 1e-12 {
                return None;
            }
            let parameter = self.normal(integer(location.0) + Rational::from_f64(nearest)?);
            let joint = as_joint(&parameter)?;
            let end = matches!(joint_pieces(self.chain, joint), (None, _) | (_, None));
            (end || !smooth_at(self.chain, joint)).then_some(parameter)
        };
        for (corner, foot) in [(candidate.s, candidate.t), (candidate.t, candidate.s)] {
            let Some(s) = corner_at(corner) else { continue };
            let exact = self.exact_foot(&s, foot).and_then(|t| self.exact_pair(&s, &t));
            if exact.is_some() {
                return exact;
            }
            let t = self.global(foot)?;
            let [_, derivative, _] = self.floats.evaluate(foot.0, foot.1);
            let ratio = dot(&derivative, &derivative).sqrt() / candidate.squared.sqrt();
            // Along the tangent the distance grows with the square of the step.
            let bits = (ratio / (0.02 * relative_width.to_f64()).sqrt())
                .log2()
                .ceil()
                .clamp(8.0, 100.0) as u32;
            let t = self.refined_foot(&s, t, bits + 16)?;
            for extra in (0..=12).step_by(2) {
                let (middle, step) = (rounded(&t, bits + extra), power_of_two(bits + extra));
                let interval = Interval {
                    start: &middle - &step,
                    end: middle + step,
                };
                let Some((pieces, _)) = sections(self.chain, &interval) else {
                    continue;
                };
                let regular = self.direction(&interval);
                let Some(reach) = self.reach_from(&s, &pieces) else {
                    continue;
                };
                let grown =
                    &reach * (Rational::from_integer(1.into()) + relative_width * Rational::new(1.into(), 20.into()));
                let squared = few_bits_between(&reach, &grown, 0.05 * relative_width.to_f64());
                let outcome =
                    widening!(64, W => critical::check_interval::<W>(self.chain, &s, &interval, &regular, &squared));
                if outcome.is_ok() {
                    let at = [s.clone(), (&interval.start + &interval.end) / integer(2)];
                    return Some(UpperBound {
                        rule: Upper::CriticalInterval {
                            s,
                            t: interval,
                            regular,
                        },
                        squared,
                        at,
                    });
                }
            }
        }
        None
    }

    /// Brings the foot of a perpendicular from c(s) nearer, to about 2^-bits.
    pub(super) fn refined_foot(&self, s: &Rational, t: Rational, bits: u32) -> Option<Rational> {
        let mut t = t;
        let at = self.local(&t);
        let corner = self.local(s);
        let ([p, ..], [q, q1, q2]) = (
            self.floats.evaluate(corner.0, corner.1),
            self.floats.evaluate(at.0, at.1),
        );
        let slope = (dot(&q1, &q1) + dot(&sub(&q, &p), &q2)) / self.field_scale(at);
        for _ in 0..16 {
            let (x, unit) = root::chord(self.chain, (&t, self.any_side(&t)), (s, self.any_side(s)))?;
            let here = point::<Integer>(self.chain, &locate(self.chain, &t, self.any_side(&t))?)?;
            let residual = Rational::new(root::product(&x, &here.field), unit * here.field_scale.value());
            let step = residual * Rational::from_f64(1.0 / slope)?;
            t = rounded(&(&t - &step), bits + 8);
            if step.numer().is_zero()
                || (step.numer().bits() as i64 - step.denom().bits() as i64) < -i64::from(bits) - 2
            {
                return Some(t);
            }
        }
        None
    }

    pub(super) fn reach_from(&self, s: &Rational, pieces: &[Section]) -> Option<Rational> {
        let corner = point::<Integer>(self.chain, &locate(self.chain, s, self.any_side(s))?)?;
        let mut most = None;
        for piece in pieces {
            most = farther(most, &corner.hull(), &section::<Integer>(self.chain, piece)?.hull())?;
        }
        most
    }
}
