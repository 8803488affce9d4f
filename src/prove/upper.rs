//! From an approximate double normal to evidence that one exists nearby.

use super::float_chain::FloatChain;
use super::newton::{self, Candidate, Location};
use super::vector::{dot, from_integers, quantised, scale, sub};
use crate::check::chain::Chain;
use crate::check::hull::{Gap, Hull};
use crate::check::rule::{critical, crossing, miranda, root};
use crate::check::section::{Section, as_joint, joint_pieces, locate, point, section, sections, smooth_at};
use crate::check::word::{Word, dot as exact_dot, widening};
use crate::claim::msd::{Convention, Interval, Side, Upper};
use crate::number::{Integer, Rational, RationalExt, approximate, simplest_between};

/// Evidence for an upper bound, and the bound it proves.
#[derive(Clone, Debug)]
pub struct UpperBound {
    /// The rule and its witness.
    pub rule: Upper,
    /// The bound of σ².
    pub squared: Rational,
    /// The two parameters, approximately or exactly.
    pub at: [Rational; 2],
}

/// The curve, exactly and in floats.
#[derive(Clone, Copy)]
pub struct Bounds<'c> {
    /// The exact chain.
    pub chain: &'c Chain,
    /// The same in floats.
    pub floats: &'c FloatChain,
    /// The statement's convention.
    pub convention: Convention,
}

fn integer(value: usize) -> Rational {
    Rational::from_integer(value.into())
}

fn power_of_two(bits: u32) -> Rational {
    Rational::new(Integer::from(1), Integer::from(1) << bits)
}

/// The rational nearest to `x` with denominator 2^bits.
fn rounded(x: &Rational, bits: u32) -> Rational {
    let half = Rational::new(Integer::from(1), Integer::from(2));
    Rational::new(
        (x * Rational::from_integer(Integer::from(1) << bits) + half)
            .floor()
            .to_integer(),
        Integer::from(1) << bits,
    )
}

/// A fraction with few bits in the closed interval [low, high] of positive numbers, whose width is about `relative` times them.
pub fn few_bits_between(low: &Rational, high: &Rational, relative: f64) -> Rational {
    // First inwards to multiples of a power of two, so that the search for the simplest fraction has small numbers.
    let size = low.numer().bits() as f64 - low.denom().bits() as f64;
    let bits = (4.0 - relative.log2() - size).ceil();
    if !(0.0..10_000.0).contains(&bits) {
        return simplest_between(low, high);
    }
    let unit = Integer::from(1) << bits as u32;
    let (inner_low, inner_high) = (low.ceil_shifted(bits as u32), high.floor_shifted(bits as u32));
    if inner_low > inner_high {
        return simplest_between(&low.reduced(), &high.reduced());
    }
    simplest_between(
        &Rational::new(inner_low, unit.clone()),
        &Rational::new(inner_high, unit),
    )
}

/// The product of fractions, not reduced.
pub fn raw_product(factors: &[&Rational]) -> Rational {
    let product = |part: fn(&Rational) -> &Integer| {
        factors
            .iter()
            .fold(Integer::from(1), |product, factor| product * part(factor))
    };
    Rational::new_raw(product(Rational::numer), product(Rational::denom))
}

impl Bounds<'_> {
    fn global(&self, location: Location) -> Option<Rational> {
        let s = integer(location.0) + Rational::from_f64(location.1)?;
        Some(self.normal(s))
    }

    /// M is written 0 on a closed curve.
    fn normal(&self, s: Rational) -> Rational {
        if self.chain.closed && s >= integer(self.chain.count()) {
            s - integer(self.chain.count())
        } else {
            s
        }
    }

    fn local(&self, s: &Rational) -> Location {
        let piece = s.numer().div_floor(s.denom()).to_u64().unwrap_or(0) as usize;
        let piece = piece.min(self.chain.count() - 1);
        (piece, (s - integer(piece)).to_f64())
    }

    /// Evidence near a candidate, with a bound within the relative width of its length.
    pub fn prove(&self, candidate: &Candidate, relative_width: &Rational) -> Option<UpperBound> {
        self.rational_root(candidate)
            .or_else(|| self.critical_interval(candidate, relative_width))
            .or_else(|| self.miranda(candidate, relative_width))
    }

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
            for denominator in [1.0, 2.0, 4.0, 8.0] {
                let fixed = ((free.1 * denominator).round() / denominator).clamp(0.0, 1.0);
                let [p, _, _] = self.floats.evaluate(free.0, fixed);
                let Some(foot) = newton::foot(self.floats, &p, other) else {
                    continue;
                };
                let Some(u) = approximate(foot.1, 1 << 20) else {
                    continue;
                };
                let Some(fixed) = Rational::from_f64(fixed) else {
                    continue;
                };
                let found = self.exact_pair(&self.normal(integer(free.0) + fixed), &self.normal(integer(foot.0) + u));
                if found.is_some() {
                    return found;
                }
            }
        }
        None
    }

    /// Is the Jacobian at the candidate nearly singular?
    fn singular(&self, candidate: &Candidate) -> bool {
        let [[a, b], [c, d]] = self.jacobian(candidate.s, candidate.t);
        (a * d - b * c).abs() < 1e-5 * (a * a + b * b + c * c + d * d)
    }

    fn jacobian(&self, s: Location, t: Location) -> [[f64; 2]; 2] {
        let ([p, p1, p2], [q, q1, q2]) = (self.floats.evaluate(s.0, s.1), self.floats.evaluate(t.0, t.1));
        let x = sub(&p, &q);
        [
            [dot(&p1, &p1) + dot(&x, &p2), -dot(&p1, &q1)],
            [dot(&p1, &q1), dot(&x, &q2) - dot(&q1, &q1)],
        ]
    }

    /// Exact evidence at two exact parameters.
    fn exact_pair(&self, s: &Rational, t: &Rational) -> Option<UpperBound> {
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

    /// |c'|/|D| at a location.
    fn field_scale(&self, location: Location) -> f64 {
        let piece = &self.floats.pieces[location.0];
        if !piece.rational {
            return piece.degree as f64;
        }
        // c' = D/w², with the weight in the floats' own scale of homogeneous coordinates; compare lengths instead.
        let [_, derivative, _] = self.floats.evaluate(location.0, location.1);
        let Some(here) = Rational::from_f64(location.1).and_then(|local| {
            point::<Integer>(
                self.chain,
                &crate::check::section::Location {
                    piece: location.0,
                    local,
                },
            )
        }) else {
            return 1.0;
        };
        let field = here
            .field
            .each_ref()
            .map(|x| super::float_chain::quotient(x, here.field_scale.doubled(0)));
        let length = (field[0] * field[0] + field[1] * field[1] + field[2] * field[2]).sqrt();
        dot(&derivative, &derivative).sqrt() / length
    }

    /// The existence of a double normal in a small box around the candidate.
    fn miranda(&self, candidate: &Candidate, relative_width: &Rational) -> Option<UpperBound> {
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
    fn miranda_near(&self, (s, t): (Rational, Rational), bits: u32, relative_width: &Rational) -> Option<UpperBound> {
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

    fn float_chord_squared(&self, s: &Rational, t: &Rational) -> f64 {
        let (s, t) = (self.local(s), self.local(t));
        let x = sub(&self.floats.evaluate(s.0, s.1)[0], &self.floats.evaluate(t.0, t.1)[0]);
        dot(&x, &x)
    }

    fn chord_squared(&self, s: &Rational, t: &Rational) -> Option<Rational> {
        let (x, unit) = root::chord(self.chain, (s, self.any_side(s)), (t, self.any_side(t)))?;
        Some(Rational::new(root::product(&x, &x), &unit * &unit))
    }

    fn any_side(&self, s: &Rational) -> Side {
        if locate(self.chain, s, Side::After).is_some() {
            Side::After
        } else {
            Side::Before
        }
    }

    /// An integer vector along the tangent in the middle of an interval.
    fn direction(&self, interval: &Interval) -> [Integer; 3] {
        let middle = self.normal((&interval.start + &interval.end) / integer(2));
        let (piece, u) = self.local(&middle);
        let [_, derivative, _] = self.floats.evaluate(piece, u);
        quantised(&derivative, 6).map(Integer::from)
    }

    /// The greatest |p−q|² over the hulls of two intervals.
    fn greatest_distance(&self, s: &Interval, t: &Interval) -> Option<Rational> {
        let (s, t) = (sections(self.chain, s)?.0, sections(self.chain, t)?.0);
        widening!(128, W => greatest_distance::<W>(self.chain, &s, &t))
    }

    /// A critical chord from a corner or an end to the inside of a piece.
    fn critical_interval(&self, candidate: &Candidate, relative_width: &Rational) -> Option<UpperBound> {
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
    fn refined_foot(&self, s: &Rational, t: Rational, bits: u32) -> Option<Rational> {
        let mut t = t;
        let at = self.local(&t);
        let corner = self.local(s);
        let ([p, ..], [q, q1, q2]) = (
            self.floats.evaluate(corner.0, corner.1),
            self.floats.evaluate(at.0, at.1),
        );
        let slope = (dot(&q1, &q1) + dot(&sub(&q, &p), &q2)) / self.field_scale(at);
        for _ in 0..8 {
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

    fn reach_from(&self, s: &Rational, pieces: &[Section]) -> Option<Rational> {
        let corner = point::<Integer>(self.chain, &locate(self.chain, s, self.any_side(s))?)?;
        let mut most = None;
        for piece in pieces {
            most = farther(most, &corner.hull(), &section::<Integer>(self.chain, piece)?.hull())?;
        }
        most
    }

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

/// The greatest |p−q|² over the hulls of two lists of sections; the outer `None` is an overflow.
fn greatest_distance<W: Word>(chain: &Chain, first: &[Section], second: &[Section]) -> Option<Option<Rational>> {
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
fn farther<W: Word>(most: Option<Rational>, a: &Hull<'_, W>, b: &Hull<'_, W>) -> Option<Option<Rational>> {
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
