//! `bend α β`: across two adjacent nodes, or within one, no chord is orthogonal to a tangent at both ends, even around a corner.
//!
//! Proof: for s in A and t in B (s < t if A = B) the chord c(t)−c(s), or its negative if A and B meet across the closing point, is ∫c' over a
//! part of A∪B of positive length, a non-negative and non-trivial combination of X(A)∪X(B). So its product with αv'+βw' is positive for
//! all tangents v' at s, w' at t, and both products cannot vanish. At an end at 0 the chord is critical when its product with the forward
//! tangent v' is ≤ 0, at an end at M when its product with w' is ≤ 0: excluded by α ≥ 0, β ≥ 0.

use std::cmp::Ordering;

use super::{Outcome, fails, is_zero_pair};
use crate::check::cover::Context;
use crate::check::element::{Element, Node};
use crate::check::hull::bring_together;
use crate::check::tangents::Tangents;
use crate::check::word::{Word, dot};
use crate::number::Integer;

/// Checks the obligation for one node (`b` is `None`) or two adjacent ones.
pub fn check<W: Word>(context: &Context, a: &Node, b: Option<&Node>, factors: &[Integer; 2]) -> Option<Outcome> {
    if is_zero_pair(factors) {
        return Some(fails("α, β not both 0", "0 0".into()));
    }
    let (alpha, beta) = (W::from_integer(&factors[0])?, W::from_integer(&factors[1])?);
    if alpha < W::zero() && a.contains_end(&context.elements, Element::Start) {
        return Some(fails("α ≥ 0 at the end at 0", format!("α = {}", factors[0])));
    }
    if beta < W::zero() && b.unwrap_or(a).contains_end(&context.elements, Element::End) {
        return Some(fails("β ≥ 0 at the end at M", format!("β = {}", factors[1])));
    }
    let tangents_a = Tangents::<W>::new(context, a)?;
    let tangents_b = match b {
        Some(b) => Some(Tangents::new(context, b)?),
        None => None,
    };
    let second = tangents_b.as_ref().unwrap_or(&tangents_a);
    // X, which for one node is counted once.
    let path = [Some(&tangents_a), tangents_b.as_ref()].into_iter().flatten();
    if path.clone().all(|tangents| tangents.of_pieces().next().is_none()) {
        return Some(fails("a node of positive length", "point elements only".into()));
    }
    // (αv+βw)·x > 0 for all v and w if and only if the least α(v·x) and the least β(w·x) have a positive sum.
    let mut holds = true;
    'all: for x in path.flat_map(|tangents| tangents.of_pieces().flatten()) {
        for (vectors_a, scale_a) in tangents_a.groups() {
            for (vectors_b, scale_b) in second.groups() {
                // v/(c·s) and w/(c·t): αv·t + βw·s is a positive multiple of the combination.
                let (s, t, _) = bring_together::<W>(scale_a, scale_b)?;
                let least_a = least(vectors_a, x, &alpha.times(&t)?)?;
                let least_b = least(vectors_b, x, &beta.times(&s)?)?;
                if let (Some(of_a), Some(of_b)) = (least_a, least_b)
                    && of_a.plus(&of_b)?.sign() != Ordering::Greater
                {
                    holds = false;
                    break 'all;
                }
            }
        }
    }
    Some(if holds {
        Ok(())
    } else {
        fails("(αv+βw)·x > 0 throughout", "a product that is not positive".into())
    })
}

/// The least of α(v·x) over all v, `None` if there is none; the outer `None` is an overflow.
fn least<W: Word>(vectors: &[[W; 3]], x: &[W; 3], alpha: &W) -> Option<Option<W>> {
    let mut least: Option<W> = None;
    for v in vectors {
        let product = dot(v, x)?.times(alpha)?;
        if least.as_ref().is_none_or(|least| product < *least) {
            least = Some(product);
        }
    }
    Some(least)
}
