//! Contacts: why a moving curve, or its polygon, meets itself at some time (FORMAT §14).
//!
//! `touch` and `crossing` are those of FORMAT §6 for the curve at one time. `passage`, proof: on the box I × J × [u₀, u₁] let G_i(s,t,u) = n_i·(c_u(s) − c_u(t)).
//! Control points of sections move linearly from u₀ to u₁, so that c_u(s₀) − q, with q a point of H_u(J) or a convex combination of them, is for every u between a convex combination of the same at
//! u₀ and u₁: the signs of G₁ on s = s₀ and s = s₁, and of G₂ on t = t₀ and t = t₁, are as required on the whole faces. Those of G₃ on u = u₀ and u = u₁ are by the products of all hull
//! points. By the Poincaré–Miranda theorem all three vanish at some (s,t,u), with u₀ < u < u₁; n₁, n₂, n₃ are independent, so that c_u(s) = c_u(t), and I and J are disjoint.

use super::positions::{MotionError, Positions};
use super::shape::Shape;
use crate::check::chain::Chain;
use crate::check::hull::Gap;
use crate::check::rule::{Failure, Outcome, crossing, root};
use crate::check::section::{Section, apart, section, sections};
use crate::check::word::{Word, vector, widening};
use crate::claim::motion::{Contact, Move};
use crate::claim::msd::Interval;
use crate::curve::{BSpline, Bezier, Curve, Form};
use crate::number::{Integer, Rational, RationalVector};

fn fails(expected: &'static str, found: impl Into<String>) -> Outcome {
    Err(Failure {
        expected,
        found: found.into(),
    })
}

/// The polygon of a curve's own control points: its edges as Bézier pieces of degree 1; closed if the curve is, or, of a B-spline, if its first and
/// last control point coincide.
///
/// `None` if it has more edges than a curve may have pieces.
pub fn polygon(curve: &Curve) -> Option<Curve> {
    let dimension = curve.dimension();
    let mut edges = Vec::new();
    let mut push = |points: &RationalVector| {
        for pair in (0..points.len() / dimension).collect::<Vec<_>>().windows(2) {
            let numerators = points.numerators()[pair[0] * dimension..(pair[1] + 1) * dimension].to_vec();
            let coordinates = RationalVector::from_parts(numerators, points.denominator().clone());
            let edge = coordinates.and_then(|coordinates| Bezier::new(dimension, coordinates, None).ok());
            edges.extend(edge);
        }
    };
    match curve.form() {
        Form::BSpline(spline) => push(spline.points()),
        Form::Bezier(pieces) => pieces.iter().for_each(|piece| push(piece.points())),
    }
    Curve::new(dimension, Form::Bezier(edges)).ok()
}

/// The curve with other positions of its own control points, given over a denominator.
pub fn curve_at(curve: &Curve, shape: &Shape, positions: &Positions, denominator: &Integer) -> Option<Curve> {
    let dimension = curve.dimension();
    let vector = |first: usize, last: usize| {
        let numerators = (first..=last).flat_map(|place| {
            let position = positions.get(place);
            position.into_iter().take(dimension)
        });
        RationalVector::from_parts(numerators.collect(), denominator.clone())
    };
    let form = match curve.form() {
        Form::BSpline(spline) => {
            let points = vector(0, positions.len() - 1)?;
            let weights = spline.weights().cloned();
            Form::BSpline(BSpline::new(dimension, spline.degree(), spline.knots().clone(), points, weights).ok()?)
        }
        Form::Bezier(pieces) => {
            let each = pieces.iter().zip(&shape.pieces).map(|(piece, at)| {
                let points = vector(at.first, at.last)?;
                Bezier::new(dimension, points, piece.weights().cloned()).ok()
            });
            Form::Bezier(each.collect::<Option<_>>()?)
        }
    };
    Curve::new(dimension, form).ok()
}

/// A curve between two frames, the first of which is number `frame`.
pub struct Stage<'s, 'c> {
    /// The curve at time 0, or the polygon.
    pub curve: &'c Curve,
    /// Its shape.
    pub shape: &'s Shape<'c>,
    /// The positions at the first frame.
    pub positions: &'s Positions,
    /// The move to the second.
    pub displacements: &'s Move,
    /// What positions are over.
    pub denominator: &'s Integer,
    /// Number of the first frame.
    pub frame: u64,
}

impl Stage<'_, '_> {
    /// The chain at a time from `frame` to `frame` + 1. Whether it is closed is a matter of all times.
    fn chain(&self, time: &Rational) -> Result<Chain, MotionError> {
        let fraction = time - Rational::from_integer(self.frame.into());
        let positions = self
            .positions
            .on_the_way(self.displacements, fraction.numer(), fraction.denom())?;
        let denominator = self.denominator * fraction.denom();
        let curve = curve_at(self.curve, self.shape, &positions, &denominator).ok_or(MotionError::Opens)?;
        let (mut chain, _) = Chain::with_points(&curve);
        chain.closed = self.shape.closed;
        Ok(chain)
    }

    /// Does a contact show that two different parameters have one point at some time after `after` and not after `by`? `by` is at most `frame` + 1.
    pub fn shows(&self, contact: &Contact, after: &Rational, by: &Rational) -> Result<Outcome, MotionError> {
        Ok(match contact {
            Contact::Touch { time, s, t } => {
                if time <= after || time > by {
                    return Ok(fails(
                        "a time after embedded_through and not after meets_by",
                        time.to_string(),
                    ));
                }
                root::check_touch(&self.chain(time)?, s, t)
            }
            Contact::Crossing {
                time,
                s,
                t,
                first,
                second,
            } => {
                if time <= after || time > by {
                    return Ok(fails(
                        "a time after embedded_through and not after meets_by",
                        time.to_string(),
                    ));
                }
                let chain = self.chain(time)?;
                widening!(64, W => crossing::check::<W>(&chain, s, t, first, second))
            }
            Contact::Passage { times, s, t, vectors } => {
                if times[0] < *after || times[0] >= times[1] || times[1] > *by {
                    let found = format!("{}, {}", times[0], times[1]);
                    return Ok(fails("two times in order from embedded_through to meets_by", found));
                }
                let chains = [self.chain(&times[0])?, self.chain(&times[1])?];
                widening!(64, W => passage::<W>(&chains, s, t, vectors))
            }
        })
    }
}

/// Checks all obligations of `passage` but those on the times.
fn passage<W: Word>(chains: &[Chain; 2], s: &Interval, t: &Interval, vectors: &[[Integer; 3]; 3]) -> Option<Outcome> {
    if chains[0].dimension != 3 {
        return Some(fails("a spatial curve", "a planar one"));
    }
    let (Some((pieces_s, _)), Some((pieces_t, _))) = (sections(&chains[0], s), sections(&chains[0], t)) else {
        return Some(fails(
            "two intervals of the curve",
            "an interval outside it, reversed or too long",
        ));
    };
    if !apart(&chains[0], s, t) {
        return Some(fails("disjoint intervals in order", "intervals that meet"));
    }
    if determinant(vectors).is_zero() {
        return Some(fails("independent n₁, n₂, n₃", "dependent ones"));
    }
    let [first, second, third] = vectors;
    let (first, second, third) = (vector::<W>(first)?, vector::<W>(second)?, vector::<W>(third)?);
    for (chain, later) in chains.iter().zip([false, true]) {
        for end in [false, true] {
            if !crossing::face(chain, &pieces_s, &pieces_t, &first, false, end)?
                || !crossing::face(chain, &pieces_t, &pieces_s, &second, true, end)?
            {
                return Some(fails("one strict sign on each face at both times", "a face without"));
            }
        }
        if !beyond(chain, &pieces_s, &pieces_t, &third, later)? {
            return Some(fails(
                "n₃·(p − q) negative at the first time and positive at the second",
                "a product that is not",
            ));
        }
    }
    Some(Ok(()))
}

fn determinant([a, b, c]: &[[Integer; 3]; 3]) -> Integer {
    let minor = |i: usize, j: usize| &b[i] * &c[j] - &b[j] * &c[i];
    &a[0] * minor(1, 2) - &a[1] * minor(0, 2) + &a[2] * minor(0, 1)
}

/// Is n·(p − q) positive (`later`) or negative for all hull points p of the one and q of the other sections?
fn beyond<W: Word>(chain: &Chain, of_p: &[Section], of_q: &[Section], n: &[W; 3], later: bool) -> Option<bool> {
    for piece_p in of_p {
        for piece_q in of_q {
            let (p, q) = (section::<W>(chain, piece_p)?, section::<W>(chain, piece_q)?);
            let (p, q) = (p.hull(), q.hull());
            let gap = if later { Gap::new(&p, &q) } else { Gap::new(&q, &p) }?;
            if !gap.positive(n)? {
                return Some(false);
            }
        }
    }
    Some(true)
}
