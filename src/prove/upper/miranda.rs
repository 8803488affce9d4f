//! A double normal in a small box of parameters.

use super::round::{few_bits_between, power_of_two, raw_product, rounded};
use super::{Bounds, UpperBound};
use crate::check::chain::Chain;
use crate::check::hull::{Gap, Hull};
use crate::check::rule::{miranda, root};
use crate::check::section::{Section, locate, point, section, sections};
use crate::check::word::{Word, dot as exact_dot, widening};
use crate::claim::msd::{Interval, Side, Upper};
use crate::number::{Integer, Rational, RationalExt};
use crate::prove::newton::Candidate;
use crate::prove::vector::{dot, quantised, sub};

impl Bounds<'_> {
    /// The existence of a double normal in a small box around the candidate.
    pub(super) fn miranda(&self, candidate: &Candidate, relative_width: &Rational) -> Option<UpperBound> {
        let (s, t) = (self.global(candidate.s)?, self.global(candidate.t)?);
        let [_, p1, _] = self.floats.evaluate(candidate.s.0, candidate.s.1);
        let [_, q1, _] = self.floats.evaluate(candidate.t.0, candidate.t.1);
        let speed = dot(&p1, &p1).max(dot(&q1, &q1)).sqrt();
        let length = candidate.squared.sqrt();
        let width = relative_width.to_f64();
        let bits = (speed / (length * (0.02 * width).sqrt()))
            .log2()
            .ceil()
            .clamp(8.0, 100.0) as u32;
        // Floats settle a well-conditioned root to about 2^-45.
        let start = (rounded(&s, bits + 8), rounded(&t, bits + 8));
        let at = if s <= t {
            [s.clone(), t.clone()]
        } else {
            [t.clone(), s.clone()]
        };
        let quick = if bits <= 36 {
            self.miranda_near(start, bits, relative_width)
        } else {
            None
        };
        match quick {
            // Floats are nearer to the root than the middle of the box is.
            Some(found) => Some(UpperBound { at, ..found }),
            None => self.miranda_near(self.refined(s, t, bits + 8)?, bits, relative_width),
        }
    }

    /// The same for two parameters that are right to a small part of 2^-bits.
    pub(super) fn miranda_near(
        &self,
        (s, t): (Rational, Rational),
        bits: u32,
        relative_width: &Rational,
    ) -> Option<UpperBound> {
        let (near_s, near_t) = if s <= t { (s, t) } else { (t, s) };
        let (s, t) = (&near_s, &near_t);
        let jacobian = self.jacobian(self.local(s), self.local(t));
        let (scale_s, scale_t) = (self.field_scale(self.local(s)), self.field_scale(self.local(t)));
        let determinant = jacobian[0][0] * jacobian[1][1] - jacobian[0][1] * jacobian[1][0];
        let row = |x: f64, y: f64| {
            let sign = determinant.signum();
            let n = quantised(&[sign * x * scale_s, sign * y * scale_t, 0.0, 0.0], 12);
            [Integer::from(n[0]), Integer::from(n[1])]
        };
        let first = row(jacobian[1][1], -jacobian[0][1]);
        let second = row(-jacobian[1][0], jacobian[0][0]);
        let one = Rational::from_integer(1.into());
        let tight = &one + relative_width * Rational::new(3.into(), 10.into());
        let grown = &one + relative_width * Rational::new(1.into(), 20.into());
        let width = relative_width.to_f64();
        // Floats tell the length to 10⁻¹⁵.
        let quick_aim = (width > 1e-13).then(|| self.float_chord_squared(s, t) * (1.0 + 0.3 * width));
        let aim = if quick_aim.is_none() {
            Some(raw_product(&[&self.chord_squared(s, t)?, &tight]))
        } else {
            None
        };
        let within = |reach: &Rational| match (quick_aim, &aim) {
            (Some(aim), _) => reach.to_f64() <= aim,
            (None, Some(aim)) => reach.numer() * aim.denom() <= aim.numer() * reach.denom(),
            (None, None) => false,
        };
        for extra in (0..=12).step_by(2) {
            let bits = bits + extra;
            let interval = |x: &Rational| {
                let (middle, step) = (rounded(x, bits), power_of_two(bits));
                Interval {
                    start: &middle - &step,
                    end: middle + step,
                }
            };
            let (s, t) = (interval(s), interval(t));
            let Some(reach) = self.greatest_distance(&s, &t).filter(within) else {
                continue;
            };
            let squared = few_bits_between(&reach, &raw_product(&[&reach, &grown]), 0.05 * width);
            for subdivisions in [1, 2, 4, 8, 16, 32] {
                let regular = [self.direction(&s), self.direction(&t)];
                let witness = miranda::Witness {
                    s: &s,
                    t: &t,
                    first: &first,
                    second: &second,
                    regular: &regular,
                    subdivisions,
                };
                let outcome = widening!(128, W => miranda::check::<W>(self.chain, &witness, &squared));
                if outcome.is_ok() {
                    let at = [near_s.clone(), near_t.clone()];
                    let rule = Upper::Miranda {
                        s,
                        t,
                        first,
                        second,
                        regular,
                        subdivisions,
                    };
                    return Some(UpperBound { rule, squared, at });
                }
                // Only the signs on the faces gain from smaller sub-sections.
                if !matches!(&outcome, Err(failure) if failure.expected.contains("face")) {
                    break;
                }
            }
        }
        None
    }

    /// Brings a root nearer by Newton steps with exact residuals, to about 2^-bits.
    fn refined(&self, s: Rational, t: Rational, bits: u32) -> Option<(Rational, Rational)> {
        let (mut s, mut t) = (s, t);
        let (a, b) = (self.local(&s), self.local(&t));
        let jacobian = self.jacobian(a, b);
        let determinant = jacobian[0][0] * jacobian[1][1] - jacobian[0][1] * jacobian[1][0];
        let (ds_scale, dt_scale) = (self.field_scale(a), self.field_scale(b));
        for _ in 0..8 {
            let (of_s, of_t) = (
                locate(self.chain, &s, Side::After)?,
                locate(self.chain, &t, Side::After)?,
            );
            let (p, q) = (
                point::<Integer>(self.chain, &of_s)?,
                point::<Integer>(self.chain, &of_t)?,
            );
            let (of_p, of_q) = (p.hull(), q.hull());
            let gap = Gap::new(&of_p, &of_q)?;
            let residual = |field: &[Integer; 3], scale: &crate::check::chain::Scale| {
                let mut value = None;
                gap.all_differences(|x, unit| {
                    value = Some(Rational::new(
                        exact_dot(x, field)?,
                        unit * gap.common.value() * scale.value(),
                    ));
                    Some(true)
                })?;
                value
            };
            let f = residual(&p.field, &p.field_scale)?;
            let g = residual(&q.field, &q.field_scale)?;
            // The residuals may be far below the least float: they are divided exactly and multiplied by a float's exact value.
            let combination = |x: f64, y: f64| Some(Rational::from_f64(x)? * &f + Rational::from_f64(y)? * &g);
            let ds = combination(
                jacobian[1][1] * ds_scale / determinant,
                -jacobian[0][1] * dt_scale / determinant,
            )?;
            let dt = combination(
                -jacobian[1][0] * ds_scale / determinant,
                jacobian[0][0] * dt_scale / determinant,
            )?;
            s = rounded(&(&s - &ds), bits + 8);
            t = rounded(&(&t - &dt), bits + 8);
            let small = |d: &Rational| {
                d.numer().is_zero() || d.numer().bits() as i64 - (d.denom().bits() as i64) < -i64::from(bits) - 2
            };
            if small(&ds) && small(&dt) {
                return Some((s, t));
            }
        }
        None
    }

    fn float_chord_squared(&self, s: &Rational, t: &Rational) -> f64 {
        let (s, t) = (self.local(s), self.local(t));
        let x = sub(&self.floats.evaluate(s.0, s.1)[0], &self.floats.evaluate(t.0, t.1)[0]);
        dot(&x, &x)
    }

    fn chord_squared(&self, s: &Rational, t: &Rational) -> Option<Rational> {
        let (x, unit) = root::chord(self.chain, (s, self.any_side(s)), (t, self.any_side(t)))?;
        Some(Rational::new(root::product(&x, &x), &unit * &unit))
    }

    /// The greatest |p−q|² over the hulls of two intervals.
    fn greatest_distance(&self, s: &Interval, t: &Interval) -> Option<Rational> {
        let (s, t) = (sections(self.chain, s)?.0, sections(self.chain, t)?.0);
        widening!(128, W => greatest_distance::<W>(self.chain, &s, &t))
    }
}

/// The greatest |p−q|² over the hulls of two lists of sections; the outer `None` is an overflow.
pub(super) fn greatest_distance<W: Word>(
    chain: &Chain,
    first: &[Section],
    second: &[Section],
) -> Option<Option<Rational>> {
    let mut most = None;
    for a in first {
        let a = section::<W>(chain, a)?;
        for b in second {
            most = farther(most, &a.hull(), &section::<W>(chain, b)?.hull())?;
        }
    }
    Some(most)
}

/// The greater of `most` and the greatest |p−q|² over two hulls.
pub(super) fn farther<W: Word>(most: Option<Rational>, a: &Hull<'_, W>, b: &Hull<'_, W>) -> Option<Option<Rational>> {
    let gap = Gap::new(a, b)?;
    // Squares over the same unit are compared as integers, which is the rule for polynomial pieces.
    let mut best: Option<(W, W)> = None;
    let mut all = most;
    let common = gap.common.value();
    let mut keep = |best: Option<(W, W)>| {
        if let Some((square, unit)) = best {
            let unit = unit.to_integer() * &common;
            let square = Rational::new_raw(square.to_integer(), &unit * &unit);
            let greater = all
                .as_ref()
                .is_none_or(|all| square.numer() * all.denom() > all.numer() * square.denom());
            if greater {
                all = Some(square);
            }
        }
    };
    gap.all_differences(|x, unit| {
        let square = exact_dot(x, x)?;
        match &best {
            Some((known, same)) if same == unit => {
                if square > *known {
                    best = Some((square, unit.clone()));
                }
            }
            _ => keep(best.replace((square, unit.clone()))),
        }
        Some(true)
    })?;
    keep(best);
    Some(all)
}
