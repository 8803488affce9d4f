//! `far n`: no chord between the two nodes is shorter than √lower_squared.
//!
//! Proof: every chord x = c(s)−c(t), s∈A, t∈B, is p−q for some p∈conv H(A), q∈conv H(B), so n·x ≥ g > 0, and |x| ≥ n·x/|n| ≥ g/|n|.

use ethnum::I256;

use super::{Outcome, fails};
use crate::check::cover::Context;
use crate::check::element::Node;
use crate::check::hull::{Gap, Hull};
use crate::check::word::{Word, dot};
use crate::number::{Integer, Rational};

/// Checks the obligation against the finite bound `lower_squared`.
pub fn check<W: Word>(
    context: &Context,
    a: &Node,
    b: &Node,
    n: &[Integer; 3],
    lower_squared: &Rational,
) -> Option<Outcome> {
    let n = crate::check::word::vector::<W>(n)?;
    let (hull_a, hull_b) = (Hull::new(context, a)?, Hull::new(context, b)?);
    let gap = Gap::new(&hull_a, &hull_b)?;
    let zero = W::zero();
    let norm = dot(&n, &n)?;
    let mut found = None;
    let common = gap.common.value();
    let holds = gap.all(&n, |g, w, v| {
        let enough = g > zero && reaches(&g, w, v, &common, &norm, lower_squared);
        if !enough {
            let denominator = w.to_integer() * v.to_integer() * &common;
            found = Some(Rational::new(g.to_integer(), denominator));
        }
        Some(enough)
    })?;
    Some(match (holds, found) {
        (true, _) => Ok(()),
        (false, found) => fails(
            "g > 0 and g² ≥ lower_squared·(n·n)",
            format!("g = {}", found.unwrap_or_default()),
        ),
    })
}

/// Is (g/(w·v·common))² ≥ lower_squared·norm, in the narrowest width that holds the products?
fn reaches<W: Word>(g: &W, w: &W, v: &W, common: &Integer, norm: &W, lower_squared: &Rational) -> bool {
    fn compare<S: Word, W: Word>(
        g: &S,
        w: &S,
        v: &S,
        common: &Integer,
        norm: &S,
        lower_squared: &Rational,
    ) -> Option<bool> {
        use crate::check::chain::convert_one;
        let (g, norm): (W, W) = (convert_one(g)?, convert_one(norm)?);
        let unit = convert_one::<S, W>(w)?
            .times(&convert_one(v)?)?
            .times(&W::from_integer(common)?)?;
        let left = g.times(&g)?.times(&W::from_integer(lower_squared.denom())?)?;
        let right = unit
            .times(&unit)?
            .times(&norm)?
            .times(&W::from_integer(lower_squared.numer())?)?;
        Some(left >= right)
    }
    small(g, w, v, common, norm, lower_squared)
        .or_else(|| compare::<W, i128>(g, w, v, common, norm, lower_squared))
        .or_else(|| compare::<W, I256>(g, w, v, common, norm, lower_squared))
        .or_else(|| compare::<W, Integer>(g, w, v, common, norm, lower_squared))
        .expect("unbounded integers do not overflow")
}

/// The same where g, the unit and the norm fit in 64 bits, as they mostly do, and the products in 128; g and all the others are positive.
#[inline]
fn small<W: Word>(g: &W, w: &W, v: &W, common: &Integer, norm: &W, lower_squared: &Rational) -> Option<bool> {
    let short = |x: &W| u64::try_from(x.to_i128()?).ok();
    let (numerator, denominator) = (lower_squared.numer().to_u64()?, lower_squared.denom().to_u64()?);
    let unit = short(w)?.checked_mul(short(v)?)?.checked_mul(common.to_u64()?)?;
    let square = |x: u64| u128::from(x) * u128::from(x);
    let left = square(short(g)?).checked_mul(denominator.into())?;
    let right = square(unit)
        .checked_mul(short(norm)?.into())?
        .checked_mul(numerator.into())?;
    Some(left >= right)
}
