//! `cone n`: all tangents of two adjacent nodes, or of one node, are within 45° of n.
//!
//! Proof: any two tangent directions on A∪B then make an angle below 90°. For s < t in A∪B (along the closing point, if that is how they
//! are adjacent) the chord c(t)−c(s) = ∫c' is a positive combination of such directions, so its product with every tangent is
//! positive. This also denies x·v ≤ 0 with the forward tangent v, the criticality at an end.

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
    let norm = dot(&n, &n)?;
    for node in std::iter::once(a).chain(b) {
        for v in Tangents::<W>::new(context, node)?.all() {
            let along = dot(v, &n)?;
            let narrow = along.sign() == Ordering::Greater && {
                let square = along.times(&along)?;
                square.plus(&square)? > dot(v, v)?.times(&norm)?
            };
            if !narrow {
                return Some(fails("every tangent within 45° of n", "a tangent that is not".into()));
            }
        }
    }
    Some(Ok(()))
}
