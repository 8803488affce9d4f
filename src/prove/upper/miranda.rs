//! A double normal in a small box of parameters.

use super::round::{few_bits_between, integer, power_of_two, raw_product, rounded};
use super::{Bounds, UpperBound};
use crate::check::chain::Chain;
use crate::check::hull::{Gap, Hull};
use crate::check::rule::{miranda, root};
use crate::check::section::{Section, as_joint, joint_pieces, locate, point, section, sections, smooth_at};
use crate::check::word::{Word, dot as exact_dot, widening};
use crate::claim::msd::{Convention, Interval, Side, Upper};
use crate::number::{Integer, Rational, RationalExt};
use crate::prove::newton::{Candidate, Location};
use crate::prove::vector::{dot, quantised, sub};

/// The rows α, β of a box, and how many more times each of its sides is halved.
struct Frame {
    first: [Integer; 2],
    second: [Integer; 2],
    finer: [u32; 2],
}

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
        let near = |(s, t): (Rational, Rational)| {
            let (s, t) = if s <= t { (s, t) } else { (t, s) };
            let frame = self.inverse_frame(&s, &t);
            self.in_frame([&s, &t], &frame, bits, relative_width)
        };
        let quick = if bits <= 36 { near(start) } else { None };
        // Floats are nearer to the root than the middle of the box is.
        if let Some(found) = quick {
            return Some(UpperBound { at, ..found });
        }
        let refined = self.refined(s, t, bits + 8).and_then(near);
        if refined.is_some() || self.convention == Convention::Smooth {
            return refined;
        }
        self.around_corners(candidate, bits, relative_width)
    }

    /// Boxes with a corner inside. There D jumps, so that the chord times D changes its sign at once where the corner is critical.
    fn around_corners(&self, candidate: &Candidate, bits: u32, relative_width: &Rational) -> Option<UpperBound> {
        let corner = |location: Location| {
            let parameter = self.normal(integer(location.0) + Rational::from_f64(location.1.round())?);
            let near = (location.1 - location.1.round()).abs() < 1e-4;
            let joint = as_joint(&parameter)?;
            (near && !smooth_at(self.chain, joint) && (joint > 0 || self.chain.closed)).then_some(joint)
        };
        let mut ends = [(candidate.s, corner(candidate.s)), (candidate.t, corner(candidate.t))];
        let parameter = |(location, joint): (Location, Option<usize>)| match joint {
            Some(joint) => Some(integer(joint)),
            None => self.global(location),
        };
        if parameter(ends[0])? > parameter(ends[1])? {
            ends.swap(0, 1);
        }
        let at = [parameter(ends[0])?, parameter(ends[1])?];
        // Which sides of the corners the derivatives are taken on.
        let sides = |(location, joint): (Location, Option<usize>)| match joint {
            Some(joint) => {
                let (before, after) = joint_pieces(self.chain, joint);
                before
                    .map(|piece| (piece, 1.0))
                    .into_iter()
                    .chain(after.map(|piece| (piece, 0.0)))
                    .collect()
            }
            None => vec![location],
        };
        if ends.iter().all(|(_, joint)| joint.is_none()) {
            return None;
        }
        for s in sides(ends[0]) {
            for t in sides(ends[1]) {
                let frames = self.corner_frames(s, t, [ends[0].1.is_some(), ends[1].1.is_some()]);
                for frame in &frames {
                    for finer in [0, 8, 16, 24] {
                        let found = self.in_frame([&at[0], &at[1]], frame, bits + finer, relative_width);
                        if found.is_some() {
                            return found;
                        }
                    }
                }
            }
        }
        None
    }

    /// Rows for a box with corners inside: the parameter without one is kept nearly constant by the box's shape.
    fn corner_frames(&self, s: Location, t: Location, corners: [bool; 2]) -> Vec<Frame> {
        let jacobian = self.jacobian(s, t);
        let [[a, b], [c, d]] = jacobian;
        let full = self.frame_of(&jacobian, s, t);
        let plain = |first: f64, second: f64| {
            let unit = |x: f64| Integer::from(if x < 0.0 { -1 } else { 1 });
            ([unit(first), Integer::ZERO], [Integer::ZERO, unit(second)])
        };
        // More halvings, so that what the other parameter changes stays below the sign.
        let shape = |keeps: f64, spoils: f64| ((spoils / keeps).abs().log2().ceil().clamp(0.0, 40.0)) as u32 + 2;
        let mut frames = Vec::new();
        for sign_s in [1.0, -1.0] {
            for sign_t in [1.0, -1.0] {
                let (first, second) = plain(sign_s, sign_t);
                let frame = |first: &[Integer; 2], second: &[Integer; 2], finer| Frame {
                    first: first.clone(),
                    second: second.clone(),
                    finer,
                };
                match corners {
                    [true, true] => frames.push(frame(&first, &second, [0, 0])),
                    [true, false] if sign_t == d.signum() => {
                        let finer = [shape(d, c), 0];
                        frames.push(frame(&first, &second, finer));
                        frames.push(frame(&full.first, &second, finer));
                    }
                    [false, true] if sign_s == a.signum() => {
                        let finer = [0, shape(a, b)];
                        frames.push(frame(&first, &second, finer));
                        frames.push(frame(&first, &full.second, finer));
                    }
                    _ => {}
                }
            }
        }
        frames
    }

    fn inverse_frame(&self, s: &Rational, t: &Rational) -> Frame {
        let (s, t) = (self.local(s), self.local(t));
        self.frame_of(&self.jacobian(s, t), s, t)
    }

    /// The rows of the inverse Jacobian, up to positive factors: they make F_i nearly a function of one parameter each.
    fn frame_of(&self, jacobian: &[[f64; 2]; 2], s: Location, t: Location) -> Frame {
        let [[a, b], [c, d]] = *jacobian;
        let (scale_s, scale_t) = (self.field_scale(s), self.field_scale(t));
        let determinant = a * d - b * c;
        // Rows of an ill-conditioned matrix are nearly parallel and need more bits.
        let condition = (a * a + b * b + c * c + d * d) / determinant.abs();
        let bits = (10.0 + condition.log2()).clamp(12.0, 50.0) as u32;
        let row = |x: f64, y: f64| {
            let sign = determinant.signum();
            let n = quantised(&[sign * x * scale_s, sign * y * scale_t, 0.0, 0.0], bits);
            [Integer::from(n[0]), Integer::from(n[1])]
        };
        Frame {
            first: row(d, -b),
            second: row(-c, a),
            finer: [0, 0],
        }
    }

    /// A box around two parameters, in order, that are right to a small part of 2^-bits.
    fn in_frame(&self, at: [&Rational; 2], frame: &Frame, bits: u32, relative_width: &Rational) -> Option<UpperBound> {
        let [near_s, near_t] = at;
        let (s, t) = (near_s, near_t);
        let Frame { first, second, finer } = frame;
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
            let interval = |x: &Rational, finer: u32| {
                let bits = bits + extra + finer;
                let (middle, step) = (rounded(x, bits), power_of_two(bits));
                Interval {
                    start: &middle - &step,
                    end: middle + step,
                }
            };
            let (mut s, mut t) = (interval(s, finer[0]), interval(t, finer[1]));
            let (mut first, mut second) = (first.clone(), second.clone());
            if self.chain.closed && s.start.numer().is_negative() {
                // Around parameter 0: counted beyond M, it comes second, and the chord turns round.
                let all = integer(self.chain.count());
                s = Interval {
                    start: &s.start + &all,
                    end: &s.end + &all,
                };
                (s, t) = (t, s);
                let turned = |[alpha, beta]: &[Integer; 2]| [-beta, -alpha];
                (first, second) = (turned(&second), turned(&first));
            }
            let Some(reach) = self.greatest_distance(&s, &t).filter(within) else {
                continue;
            };
            let squared = few_bits_between(&reach, &raw_product(&[&reach, &grown]), 0.05 * width);
            for subdivisions in [1, 2, 4, 8] {
                let regular = [self.direction(&s), self.direction(&t)];
                let witness = miranda::Witness {
                    s: &s,
                    t: &t,
                    first: &first,
                    second: &second,
                    regular: &regular,
                    subdivisions,
                };
                let outcome = widening!(128, W => miranda::check::<W>(self.chain, &witness, self.convention, &squared));
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
