//! `separate n`: a plane orthogonal to n lies strictly between the two nodes.
//!
//! Proof: c(s) is in conv H(A) and c(t) in conv H(B), so n·c(s) − n·c(t) ≥ min n·p − max n·q > 0, and the two points differ.

use super::{Outcome, fails};
use crate::check::cover::Context;
use crate::check::element::Node;
use crate::check::hull::{Gap, Hull};
use crate::check::word::Word;
use crate::number::Integer;

/// Checks the obligation for two different nodes. The vector 0 separates nothing.
pub fn check<W: Word>(context: &Context, a: &Node, b: &Node, n: &[Integer; 3]) -> Option<Outcome> {
    let n = crate::check::word::vector::<W>(n)?;
    let (hull_a, hull_b) = (Hull::new(context, a)?, Hull::new(context, b)?);
    let holds = Gap::new(&hull_a, &hull_b)?.positive(&n)?;
    Some(if holds {
        Ok(())
    } else {
        fails("min n·p − max n·q > 0", "a value that is not".into())
    })
}
