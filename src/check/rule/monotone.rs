//! `monotone n`: along one node, or along two adjacent ones, the curve moves strictly in the direction n.
//!
//! Proof: on each part c' is a positive function times D = Σ B_k D_k with D_k·n > 0 or D_k = 0, not all of them 0. So n·c' > 0 but for
//! finitely many parameters, and n·c increases strictly along A∪B (along the closing point, if that is how they are adjacent):
//! different parameters have different points.

use std::cmp::Ordering;

use super::{Outcome, fails, is_zero_vector};
use crate::check::cover::Context;
use crate::check::element::Node;
use crate::check::tangents::Tangents;
use crate::check::word::{Word, dot};
use crate::number::Integer;

/// Checks the obligation for one node (`b` is `None`) or two adjacent ones.
pub fn check<W: Word>(context: &Context, a: &Node, b: Option<&Node>, n: &[Integer; 3]) -> Option<Outcome> {
    if is_zero_vector(n) {
        return Some(fails("n ≠ 0", "0".into()));
    }
    let n = crate::check::word::vector::<W>(n)?;
    for node in std::iter::once(a).chain(b) {
        for v in Tangents::<W>::new(context, node)?.all() {
            if dot(v, &n)?.sign() != Ordering::Greater {
                return Some(fails("v·n > 0 for every tangent v", "a tangent without".into()));
            }
        }
    }
    Some(Ok(()))
}
