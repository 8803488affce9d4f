//! `crossing`: a planar curve passes twice through a point, in a box of parameters (FORMAT §6).
//!
//! Proof: G_i(s,t) = n_i·(c(s)−c(t)) is continuous, G₁ has opposite signs on s = s₀ and s = s₁, G₂ on t = t₀ and t = t₁, so both vanish at some (s,t)
//! by the Poincaré–Miranda theorem; n₁, n₂ are independent, so c(s) = c(t); I and J are disjoint, so the parameters differ.

use super::{Outcome, fails};
use crate::check::chain::Chain;
use crate::check::hull::Gap;
use crate::check::section::{Section, apart, end_of, point, section, sections};
use crate::check::word::{Word, vector};
use crate::claim::msd::Interval;
use crate::number::Integer;

/// Checks all obligations.
pub fn check<W: Word>(
    chain: &Chain,
    s: &Interval,
    t: &Interval,
    first: &[Integer; 3],
    second: &[Integer; 3],
) -> Option<Outcome> {
    if chain.dimension != 2 {
        return Some(fails("a planar curve", "a spatial one".into()));
    }
    let (Some((pieces_s, _)), Some((pieces_t, _))) = (sections(chain, s), sections(chain, t)) else {
        return Some(fails(
            "two intervals of the curve",
            "an interval outside it, reversed or too long".into(),
        ));
    };
    if !apart(chain, s, t) {
        return Some(fails("disjoint intervals in order", "intervals that meet".into()));
    }
    if &first[0] * &second[1] == &first[1] * &second[0] {
        return Some(fails("independent n₁, n₂", "dependent ones".into()));
    }
    let (first, second) = (vector::<W>(first)?, vector::<W>(second)?);
    for end in [false, true] {
        if !face(chain, &pieces_s, &pieces_t, &first, false, end)?
            || !face(chain, &pieces_t, &pieces_s, &second, true, end)?
        {
            return Some(fails("one strict sign on each face", "a face without".into()));
        }
    }
    Some(Ok(()))
}

/// n·(p−q) negative at the start of `across`, positive at its end, where p is there and q on `along`, or the reverse if `swapped`.
pub fn face<W: Word>(
    chain: &Chain,
    across: &[Section],
    along: &[Section],
    n: &[W; 3],
    swapped: bool,
    end: bool,
) -> Option<bool> {
    let here = point::<W>(chain, &end_of(across, end))?;
    let zero = W::zero();
    let n = if end {
        n.clone()
    } else {
        [zero.minus(&n[0])?, zero.minus(&n[1])?, zero.minus(&n[2])?]
    };
    for piece in along {
        let part = section::<W>(chain, piece)?;
        let (point, hull) = (here.hull(), part.hull());
        let gap = if swapped {
            Gap::new(&hull, &point)
        } else {
            Gap::new(&point, &hull)
        }?;
        if !gap.positive(&n)? {
            return Some(false);
        }
    }
    Some(true)
}
