//! `not_normal α β`: no chord between the two nodes is orthogonal to a tangent at both of its ends.
//!
//! Proof: a chord x = c(s)−c(t) is a convex combination of the p−q, and one-sided tangents at s and t are non-negative, non-trivial
//! combinations v', w' of T(A) and of T(B), each scaled to coefficients of sum 1. Then x·(αv'+βw') > 0, so x·v' = x·w' = 0 is
//! impossible. At an end of an open curve the chord is critical when x·v' ≥ 0 (end at 0, in A; v' points into the curve and x from the
//! other point to the end) or x·w' ≥ 0 (end at M, in B; w' points out of the curve, x from the end to the other point): then α ≤ 0, β ≤ 0
//! lead to the same contradiction.

use super::{Outcome, fails, is_zero_pair};
use crate::check::cover::Context;
use crate::check::element::{Element, Node};
use crate::check::hull::{Gap, Hull};
use crate::check::tangents::{Tangents, all_combinations, all_multiples};
use crate::check::word::Word;
use crate::number::Integer;

/// Checks the obligation for two different nodes.
pub fn check<W: Word>(context: &Context, a: &Node, b: &Node, factors: &[Integer; 2]) -> Option<Outcome> {
    if is_zero_pair(factors) {
        return Some(fails("α, β not both 0", "0 0".into()));
    }
    let (alpha, beta) = (W::from_integer(&factors[0])?, W::from_integer(&factors[1])?);
    let has_end = |node: &Node| {
        node.contains_end(&context.elements, Element::Start) || node.contains_end(&context.elements, Element::End)
    };
    if alpha > W::zero() && has_end(a) {
        return Some(fails("α ≤ 0 at an end of the curve", format!("α = {}", factors[0])));
    }
    if beta > W::zero() && has_end(b) {
        return Some(fails("β ≤ 0 at an end of the curve", format!("β = {}", factors[1])));
    }
    let (hull_a, hull_b) = (Hull::new(context, a)?, Hull::new(context, b)?);
    let gap = Gap::new(&hull_a, &hull_b)?;
    let positive = |y: &[W; 3]| gap.positive(y);
    // A side whose factor is 0 is not looked at: it has a tangent, and any one stands for all.
    let holds = if beta.vanishes() {
        all_multiples(&Tangents::new(context, a)?, &alpha, positive)
    } else if alpha.vanishes() {
        all_multiples(&Tangents::new(context, b)?, &beta, positive)
    } else {
        let (tangents_a, tangents_b) = (Tangents::new(context, a)?, Tangents::new(context, b)?);
        all_combinations(&tangents_a, &tangents_b, &alpha, &beta, positive)
    }?;
    Some(if holds {
        Ok(())
    } else {
        fails("(p−q)·(αv+βw) > 0 throughout", "a product that is not positive".into())
    })
}
