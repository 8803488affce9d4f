//! `turn p q`: across two adjacent nodes, or within one, no chord is orthogonal to a tangent at both ends, however sharp the corner between them.
//!
//! Proof: as for `bend`, the chord y = c(t)−c(s), or its negative across the closing point, is a non-negative and non-trivial combination of X(A)∪X(B).
//! Every tangent at s is a positive multiple of a combination of the vectors v/(p·v), v∈T(A), with non-negative coefficients of sum 1, since p·v > 0; every tangent at t
//! likewise of the w/(q·w). The obligation says (v/(p·v) + w/(q·w))·x > 0, so y has a positive product with the sum of the two, and is not orthogonal to
//! both. At an end of an open curve criticality makes one product ≤ 0, which leads to the same contradiction.

use super::{Outcome, fails, is_zero_vector};
use crate::check::cover::Context;
use crate::check::element::Node;
use crate::check::tangents::Tangents;
use crate::check::word::{Word, combine, dot, vector};
use crate::number::Integer;

/// Checks the obligation for one node (`b` is `None`) or two adjacent ones.
pub fn check<W: Word>(
    context: &Context,
    a: &Node,
    b: Option<&Node>,
    p: &[Integer; 3],
    q: &[Integer; 3],
) -> Option<Outcome> {
    if is_zero_vector(p) || is_zero_vector(q) {
        return Some(fails("p, q not 0", "a zero vector".into()));
    }
    let (p, q) = (vector::<W>(p)?, vector::<W>(q)?);
    let tangents_a = Tangents::<W>::new(context, a)?;
    let tangents_b = match b {
        Some(b) => Some(Tangents::new(context, b)?),
        None => None,
    };
    let second = tangents_b.as_ref().unwrap_or(&tangents_a);
    let (Some(along_a), Some(along_b)) = (along(&tangents_a, &p)?, along(second, &q)?) else {
        return Some(fails(
            "p·v > 0 and q·w > 0 throughout",
            "a product that is not positive".into(),
        ));
    };
    // X, which for one node is counted once.
    let path = [Some(&tangents_a), tangents_b.as_ref()].into_iter().flatten();
    let path: Vec<&[W; 3]> = path.flat_map(|tangents| tangents.of_pieces().flatten()).collect();
    if path.is_empty() {
        return Some(fails("a node of positive length", "point elements only".into()));
    }
    for (v, of_v) in tangents_a.all().iter().zip(&along_a) {
        for (w, of_w) in second.all().iter().zip(&along_b) {
            let sum = combine(of_w, v, of_v, w)?;
            for x in &path {
                if dot(&sum, x)? <= W::zero() {
                    return Some(fails(
                        "((q·w)v + (p·v)w)·x > 0 throughout",
                        "a product that is not positive".into(),
                    ));
                }
            }
        }
    }
    Some(Ok(()))
}

/// n·v for all v; the inner `None` when one is not positive, the outer one when one overflows.
fn along<W: Word>(tangents: &Tangents<W>, n: &[W; 3]) -> Option<Option<Vec<W>>> {
    let products: Vec<W> = tangents.all().iter().map(|v| dot(n, v)).collect::<Option<_>>()?;
    let positive = products.iter().all(|product| *product > W::zero());
    Some(positive.then_some(products))
}
