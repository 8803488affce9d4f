//! `pedal z₁ z₂ r l m`: in the plane, the tangents at the two ends of a double normal are as far apart as a point z = (z₁, z₂)/r tells.
//!
//! Proof: a double normal x = c(s)−c(t), s in A and t in B, is orthogonal to a tangent at each end, so the two tangent lines are parallel and |x| is their distance. Let a = c(s)−z, b = c(t)−z, n = x/|x|.
//! |a·n| is the distance of z from the tangent line at s. Its square is ((c−z)×D)²/|D|², at a zero of D the limit from the side of the tangent; so if (w(c−z)×D)²
//! is at least (k/r)²·w²|D|² on a part, all these distances are at least k/r, and if it is at most that, they are at most k/r. |x| = |a·n − b·n|.
//! If l and m have opposite signs, |x| ≥ ||a·n| − |b·n|| ≥ (l+m)/r > 0. If both are positive, a·b ≤ 0 (by hull points, bilinearly) and |a| ≥ |a·n| > 0 give a·x = |a|² − a·b > 0 and
//! b·x = a·b − |b|² < 0, so a·n and b·n have opposite signs and |x| = |a·n| + |b·n| ≥ (l+m)/r.
//!
//! A chord x = 0 has no n and is excluded apart: with a = b, a·b ≤ 0 says a = 0, but a point on a line at least l/r from z is not z. With opposite signs, one part's points are
//! at least k/r from z, as they lie on their tangents, and the other's nearer, being in the hull of points nearer than k/r.

use super::{Outcome, fails};
use crate::check::chain::Chain;
use crate::check::element::Node;
use crate::check::part::{Block, Geometry, Part};
use crate::check::polynomial::{convolution, scaled};
use crate::check::word::Word;
use crate::number::{Integer, Rational};

/// Checks the obligation for two different parts.
pub fn check(chain: &Chain, a: &Node, b: &Node, witness: &[Integer; 5], lower_squared: &Rational) -> Outcome {
    let (Node::Part(a), Node::Part(b)) = (a, b) else {
        return fails("two parts of pieces", "a run, a corner or an end".into());
    };
    if chain.dimension != 2 {
        return fails("a planar curve", "a spatial one".into());
    }
    let [z1, z2, r, l, m] = witness;
    if !r.is_positive() || l.is_zero() || m.is_zero() {
        return fails("r > 0, l and m not 0", format!("r = {r}, l = {l}, m = {m}"));
    }
    let sum = l + m;
    if !sum.is_positive() || &sum * &sum * lower_squared.denom() < r * r * lower_squared.numer() {
        return fails("l+m > 0 and (l+m)² ≥ r²·lower_squared", format!("l+m = {sum}"));
    }
    let (from_a, from_b) = (Seen::new(chain, a, [z1, z2], r), Seen::new(chain, b, [z1, z2], r));
    for (seen, bound) in [(&from_a, l), (&from_b, m)] {
        if !seen.keeps(bound) {
            let expected = if bound.is_positive() {
                "all tangents as far from z as stated"
            } else {
                "all tangents as near to z as stated"
            };
            return fails(expected, format!("not shown for {bound}/r"));
        }
    }
    if l.is_positive() && m.is_positive() {
        for p in &from_a.chords {
            for q in &from_b.chords {
                if (&p[0] * &q[0] + &p[1] * &q[1]).is_positive() {
                    return fails("(p−z)·(q−z) ≤ 0 for all hull points", "a positive product".into());
                }
            }
        }
        return Ok(());
    }
    let (inner, outer) = if l.is_positive() { (&from_b, l) } else { (&from_a, m) };
    for (q, weight) in inner.chords.iter().zip(&inner.weights) {
        if &q[0] * &q[0] + &q[1] * &q[1] >= (outer * weight).pow(2) {
            return fails(
                "the nearer part's hull points nearer to z than the other's tangents",
                "a point as far".into(),
            );
        }
    }
    Ok(())
}

/// A part seen from z: the Bernstein coefficients of w·(rc − rz), of w and of D, each list up to a positive factor shared by the first two.
pub struct Seen {
    chords: Vec<[Integer; 2]>,
    weights: Vec<Integer>,
    fields: Vec<[Integer; 2]>,
}

impl Seen {
    /// The part as seen from z/r.
    pub fn new(chain: &Chain, part: &Part, z: [&Integer; 2], r: &Integer) -> Self {
        let shared = part.point_scale(chain).value();
        match &part.geometry {
            Geometry::Narrow(block) => Seen::of_block(block, &shared, z, r),
            Geometry::Wide(block) => Seen::of_block(block, &shared, z, r),
            Geometry::Large(block) => Seen::of_block(block, &shared, z, r),
        }
    }

    fn of_block<W: Word>(block: &Block<W>, shared: &Integer, z: [&Integer; 2], r: &Integer) -> Self {
        let weight = |k: usize| block.weights().get(k).map_or_else(|| shared.clone(), W::to_integer);
        let weights: Vec<Integer> = (0..block.points().len()).map(weight).collect();
        let chord = |(point, weight): (&[W; 3], &Integer)| [0, 1].map(|i| r * point[i].to_integer() - weight * z[i]);
        Seen {
            chords: block.points().iter().zip(&weights).map(chord).collect(),
            fields: block
                .tangents()
                .iter()
                .map(|v| [v[0].to_integer(), v[1].to_integer()])
                .collect(),
            weights,
        }
    }

    /// The squares of w·(rc − rz)×D and of w·|D|, as coefficients times binomials.
    pub fn squares(&self) -> (Vec<Integer>, Vec<Integer>) {
        let column = |vectors: &[[Integer; 2]], i: usize| -> Vec<Integer> {
            scaled(&vectors.iter().map(|v| v[i].clone()).collect::<Vec<_>>())
        };
        let [x, y] = [0, 1].map(|i| column(&self.chords, i));
        let [dx, dy] = [0, 1].map(|i| column(&self.fields, i));
        let combined = |a: Vec<Integer>, b: Vec<Integer>, minus: bool| -> Vec<Integer> {
            let signed = |(a, b): (Integer, Integer)| if minus { a - b } else { a + b };
            a.into_iter().zip(b).map(signed).collect()
        };
        let cross = combined(convolution(&x, &dy), convolution(&y, &dx), true);
        let speed = combined(convolution(&dx, &dx), convolution(&dy, &dy), false);
        let weights = scaled(&self.weights);
        (
            convolution(&cross, &cross),
            convolution(&convolution(&weights, &weights), &speed),
        )
    }

    /// The point and D at both ends, each over r and up to a positive factor of D.
    pub fn ends(&self) -> Option<[([Rational; 2], [Rational; 2]); 2]> {
        let at = |chord: &[Integer; 2], weight: &Integer, field: &[Integer; 2]| {
            let point = [0, 1].map(|i| Rational::new(chord[i].clone(), weight.clone()));
            (point, field.clone().map(Rational::from_integer))
        };
        Some([
            at(self.chords.first()?, self.weights.first()?, self.fields.first()?),
            at(self.chords.last()?, self.weights.last()?, self.fields.last()?),
        ])
    }

    /// Is every tangent at least `bound`/r from z, or at most that when `bound` is negative?
    fn keeps(&self, bound: &Integer) -> bool {
        let (distance, unit) = self.squares();
        let square = bound * bound;
        distance.iter().zip(&unit).all(|(distance, unit)| {
            let difference = distance - unit * &square;
            if bound.is_positive() {
                !difference.is_negative()
            } else {
                !difference.is_positive()
            }
        })
    }
}
