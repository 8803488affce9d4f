//! `critical_root` and `critical_interval`: critical chords at corners and ends (FORMAT §4, §6).
//!
//! Proof of `critical_interval`: the chord from E to c(t) is critical at E for every t in J, because the sign conditions, linear in the other end q,
//! hold on all of H(J). (c(t)−E)·D(t) changes its sign between t₀ and t₁; D is continuous but for positive factors at smooth joints and does not vanish, so the product
//! vanishes at some t in J, where the chord is orthogonal to the tangent.

use std::cmp::Ordering;

use super::miranda::{at_most, regular, restricted};
use super::root::{self, chord, ordered, product};
use super::{Outcome, fails};
use crate::check::chain::Chain;
use crate::check::element::corner_pieces;
use crate::check::hull::{Gap, Hull};
use crate::check::section::{
    HullAndField, as_joint, direction, end_of, is_parameter, joint_pieces, locate, point, sections, smooth_at,
};
use crate::check::word::{Word, vector};
use crate::claim::msd::{Interval, Side};
use crate::number::{Integer, Rational};

/// What a parameter is in the critical convention.
enum Kind {
    /// A corner with its incoming and outgoing direction.
    Corner([Integer; 3], [Integer; 3]),
    /// An end, with the direction into the curve.
    End([Integer; 3]),
    /// Any other point.
    Regular,
}

fn kind(chain: &Chain, s: &Rational) -> Kind {
    let Some(joint) = as_joint(s) else { return Kind::Regular };
    match joint_pieces(chain, joint) {
        (None, Some(after)) => Kind::End(chain.end_direction(after, false)),
        (Some(before), None) => Kind::End(chain.end_direction(before, true).map(|x| -x)),
        _ if smooth_at(chain, joint) => Kind::Regular,
        _ => {
            let (before, after) = corner_pieces(chain, joint % chain.count());
            Kind::Corner(chain.end_direction(before, true), chain.end_direction(after, false))
        }
    }
}

fn side_of(chain: &Chain, s: &Rational) -> Side {
    if locate(chain, s, Side::After).is_some() {
        Side::After
    } else {
        Side::Before
    }
}

/// Checks `critical_root`.
pub fn check_root(chain: &Chain, s: &Rational, t: &Rational, upper_squared: &Rational) -> Outcome {
    ordered(chain, s, t)?;
    let sides = (side_of(chain, s), side_of(chain, t));
    let Some((x, unit)) = chord(chain, (s, sides.0), (t, sides.1)) else {
        return fails("two parameters of the curve", format!("{s}, {t}"));
    };
    // x points from c(t) to c(s); at an end the chord is (other − end)·v ≤ 0.
    for (parameter, side, to_other) in [(s, sides.0, -1i64), (t, sides.1, 1)] {
        let critical = match kind(chain, parameter) {
            Kind::Corner(a, b) => (product(&x, &a) * product(&x, &b)).sign() != Ordering::Greater,
            Kind::End(v) => (product(&x, &v) * Integer::from(to_other)).sign() != Ordering::Greater,
            Kind::Regular => {
                let location = locate(chain, parameter, side).expect("located for the chord");
                match direction(chain, &location) {
                    Some(v) => product(&x, &v).vanishes(),
                    None => return fails("a tangent direction", format!("the derivative vanishes at {parameter}")),
                }
            }
        };
        if !critical {
            return fails("a critical chord", format!("not critical at {parameter}"));
        }
    }
    root::at_most(&x, &unit, upper_squared)
}

/// Checks `critical_interval`.
pub fn check_interval<W: Word>(
    chain: &Chain,
    s: &Rational,
    t: &Interval,
    m: &[Integer; 3],
    upper_squared: &Rational,
) -> Option<Outcome> {
    if !is_parameter(chain, s) {
        return Some(fails("a parameter of the curve", s.to_string()));
    }
    let signs: Vec<([W; 3], bool)> = match kind(chain, s) {
        Kind::Regular => return Some(fails("a corner or an end", format!("neither at {s}"))),
        // The pairs (v, true) demand (E−q)·v ≥ 0.
        Kind::End(v) => vec![(vector(&v)?, true)],
        Kind::Corner(a, b) => vec![(vector(&a)?, true), (vector(&b)?, false)],
    };
    let Some((pieces, joint)) = sections(chain, t) else {
        return Some(fails(
            "an interval of the curve",
            "an interval outside it, reversed or too long".into(),
        ));
    };
    let again = s + Rational::from_integer(chain.count().into());
    let inside = |s: &Rational| t.start <= *s && *s <= t.end;
    if inside(s) || chain.closed && inside(&again) {
        return Some(fails("s outside the interval", s.to_string()));
    }
    if let Some(joint) = joint.filter(|joint| !smooth_at(chain, *joint)) {
        return Some(fails("no corner inside", format!("the corner at {joint}")));
    }
    let whole = restricted::<W>(chain, &pieces, 1)?;
    if !regular(&whole, m)? {
        return Some(fails(
            "m·w > 0 for all tangents of the interval",
            "a product that is not positive".into(),
        ));
    }
    let corner = point::<W>(chain, &locate(chain, s, side_of(chain, s))?)?;
    let one_way = one_sided(&corner.hull(), &whole, &signs, false)?;
    let critical = one_way || signs.len() == 2 && one_sided(&corner.hull(), &whole, &signs, true)?;
    if !critical {
        return Some(fails(
            "a chord critical at s for all of the interval",
            "one that is not".into(),
        ));
    }
    let mut at_ends = Vec::new();
    for end in [false, true] {
        let here = point::<W>(chain, &end_of(&pieces, end))?;
        let mut sign = Ordering::Equal;
        Gap::new(&here.hull(), &corner.hull())?.all(&here.field, |gap, _, _| {
            sign = gap.sign();
            Some(true)
        })?;
        at_ends.push(sign);
    }
    if at_ends[0] == Ordering::Equal || at_ends[0] != at_ends[1].reverse() {
        return Some(fails(
            "opposite signs at the ends of the interval",
            format!("{at_ends:?}"),
        ));
    }
    for part in &whole {
        if !at_most(&corner.hull(), &part.hull(), upper_squared)? {
            return Some(fails(
                "upper_squared ≥ |E−q|² for all hull points",
                "a longer difference".into(),
            ));
        }
    }
    Some(Ok(()))
}

/// Is (E−q)·v ≥ 0 for all q where `signs` says `true`, ≤ 0 where it says `false` (all reversed if `reverse`)?
fn one_sided<W: Word>(
    corner: &Hull<'_, W>,
    whole: &[HullAndField<W>],
    signs: &[([W; 3], bool)],
    reverse: bool,
) -> Option<bool> {
    for part in whole {
        let hull = part.hull();
        for (v, positive) in signs {
            // The least of (E−q)·v, or of (q−E)·v.
            let gap = if *positive != reverse {
                Gap::new(corner, &hull)
            } else {
                Gap::new(&hull, corner)
            }?;
            if !gap.all(v, |g, _, _| Some(g >= W::zero()))? {
                return Some(false);
            }
        }
    }
    Some(true)
}
