//! A quick test that a leaf's margin is not below a bound, so that it need not be computed: in machine integers, without adding coefficients.
//!
//! Σ|m_j| is at most 2 for a difference of hull points, which are convex combinations, and for a D_k of a polynomial part, a convex combination of
//! the P_{j+1} − P_j. So half of the least value is at most the margin. Boxes of runs contain the control points.

use crate::check::chain::ScaleRef;
use crate::check::cover::Context;
use crate::check::element::Node;
use crate::check::hull::{Gap, Hull};
use crate::check::tangents::Tangents;
use crate::check::word::{Word, dot, vector, widening};
use crate::claim::tree::Leaf;
use crate::number::{Integer, Rational};

/// Is the leaf's margin certainly at least `bound`·|n|₁? The leaf's obligation holds; `bound` > 0.
pub fn at_least(context: &Context, a: &Node, b: Option<&Node>, leaf: &Leaf, bound: &Rational) -> bool {
    match (leaf, b) {
        (Leaf::Separate(n), Some(b)) => widening!(0, W => gap_at_least::<W>(context, a, b, n, bound)),
        (Leaf::Monotone(n), b) => std::iter::once(a)
            .chain(b)
            .all(|node| widening!(0, W => slope_at_least::<W>(context, node, n, bound))),
        _ => false,
    }
}

/// 2·|n|₁ times the numerator of the bound, and its denominator.
fn factors<W: Word>(n: &[Integer; 3], bound: &Rational) -> Option<(W, W)> {
    let sum = n.iter().fold(Integer::ZERO, |sum, x| sum + x.abs());
    let twice = W::from_integer(&sum)?.doubled(1)?;
    Some((
        twice.times(&W::from_integer(bound.numer())?)?,
        W::from_integer(bound.denom())?,
    ))
}

fn gap_at_least<W: Word>(context: &Context, a: &Node, b: &Node, n: &[Integer; 3], bound: &Rational) -> Option<bool> {
    let (numerator, denominator) = factors::<W>(n, bound)?;
    let (hull_a, hull_b) = (Hull::<W>::new(context, a)?, Hull::new(context, b)?);
    let gap = Gap::new(&hull_a, &hull_b)?;
    let least = numerator.times(&scale(gap.common)?)?;
    gap.all(&vector(n)?, |g, w, v| {
        Some(g.times(&denominator)? >= least.times(w)?.times(v)?)
    })
}

/// `false` where a piece is rational or a coefficient of D is zero.
fn slope_at_least<W: Word>(context: &Context, node: &Node, n: &[Integer; 3], bound: &Rational) -> Option<bool> {
    let pieces = match node {
        Node::Run { first, last, .. } => *first..*last,
        Node::Part(part) => part.piece..part.piece + 1,
        Node::Point(_) => return Some(false),
    };
    let pieces = &context.chain.pieces[pieces];
    if pieces.iter().any(|piece| piece.rational) {
        return Some(false);
    }
    let tangents = Tangents::<W>::new(context, node)?;
    if tangents.all().len() < pieces.iter().map(|piece| piece.degree).sum::<usize>() {
        return Some(false);
    }
    let (numerator, denominator) = factors::<W>(n, bound)?;
    let n = vector(n)?;
    for (vectors, unit) in tangents.groups() {
        let least = numerator.times(&scale(unit)?)?;
        for v in vectors {
            if dot(v, &n)?.times(&denominator)? < least {
                return Some(false);
            }
        }
    }
    Some(true)
}

fn scale<W: Word>(scale: ScaleRef) -> Option<W> {
    W::from_integer(scale.odd)?.doubled(scale.exponent)
}
