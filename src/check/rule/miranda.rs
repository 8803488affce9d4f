//! `miranda`: a double normal exists in a box of parameters (FORMAT §6).
//!
//! Proof: on each face one argument is fixed, and F_i(s,t) = (c(s)−c(t))·(α_i D(s)+β_i D(t)) is a polynomial over a positive one, the weight; all its Bernstein coefficients
//! have one sign, so F₁ has opposite signs on s = s₀ and s = s₁, and F₂ on t = t₀ and t = t₁. If no joint is inside, F is continuous
//! and vanishes somewhere by the Poincaré–Miranda theorem; as α₁β₂ ≠ α₂β₁ the chord is orthogonal to D(s) and D(t), neither of which vanishes because m·D > 0.
//! At a smooth joint inside, D jumps from D⁻ to D⁺ = λD⁻, λ > 0. Widen the joint to a segment on which c stands still and D passes from D⁻ to D⁺ linearly: F
//! is continuous on the longer box; on its faces F is linear in D there, so its sign is that of the two ends, which are tested; a zero on the segment is one at the joint.
//! The same holds at a corner in the convention `critical`: a zero on the segment is a chord orthogonal to some λD⁻ + μD⁺, which is what critical means there.

use super::{Outcome, fails};
use crate::check::chain::Chain;
use crate::check::hull::{Gap, Hull, bring_together};
use crate::check::section::{HullAndField, PointAndField, Section, apart, end_of, point, section, sections, smooth_at};
use crate::check::word::{Word, combine, dot, vector};
use crate::claim::msd::{Convention, Interval};
use crate::number::{Integer, Rational};

/// The witness of the rule.
pub struct Witness<'w> {
    /// I.
    pub s: &'w Interval,
    /// J.
    pub t: &'w Interval,
    /// α₁, β₁.
    pub first: &'w [Integer; 2],
    /// α₂, β₂.
    pub second: &'w [Integer; 2],
    /// m_I, m_J.
    pub regular: &'w [[Integer; 3]; 2],
    /// Sub-sections of each section on the faces.
    pub subdivisions: u32,
}

/// Checks all obligations.
pub fn check<W: Word>(
    chain: &Chain,
    witness: &Witness,
    convention: Convention,
    upper_squared: &Rational,
) -> Option<Outcome> {
    if !(1..=1024).contains(&witness.subdivisions) {
        return Some(fails("1 to 1,024 subdivisions", witness.subdivisions.to_string()));
    }
    let (Some((pieces_s, joint_s)), Some((pieces_t, joint_t))) =
        (sections(chain, witness.s), sections(chain, witness.t))
    else {
        return Some(fails(
            "two intervals of the curve",
            "an interval outside it, reversed or too long".into(),
        ));
    };
    if !apart(chain, witness.s, witness.t) {
        return Some(fails("disjoint intervals in order", "intervals that meet".into()));
    }
    let mut joints = joint_s.into_iter().chain(joint_t);
    if convention == Convention::Smooth
        && let Some(joint) = joints.find(|joint| !smooth_at(chain, *joint))
    {
        return Some(fails("no corner inside", format!("the corner at {joint}")));
    }
    let ([a1, b1], [a2, b2]) = (witness.first, witness.second);
    if a1 * b2 == a2 * b1 {
        return Some(fails("α₁β₂ ≠ α₂β₁", "equal".into()));
    }
    let (whole_s, whole_t) = (
        restricted::<W>(chain, &pieces_s, 1)?,
        restricted::<W>(chain, &pieces_t, 1)?,
    );
    for (whole, m) in [(&whole_s, &witness.regular[0]), (&whole_t, &witness.regular[1])] {
        if !regular(whole, m)? {
            return Some(fails(
                "m·v > 0 for all tangents of an interval",
                "a product that is not positive".into(),
            ));
        }
    }
    let faces = [
        (&pieces_s, (&pieces_t, &whole_t), witness.first, false),
        (&pieces_t, (&pieces_s, &whole_s), witness.second, true),
    ];
    for (across, (along, whole), factors, swapped) in faces {
        let subdivided;
        let parts = if witness.subdivisions == 1 {
            whole
        } else {
            subdivided = restricted::<W>(chain, along, witness.subdivisions)?;
            &subdivided
        };
        for end in [false, true] {
            let here = point::<W>(chain, &end_of(across, end))?;
            for part in parts {
                if !face(&here, part, factors, swapped, end)? {
                    let which = if swapped { "t" } else { "s" };
                    return Some(fails(
                        "one strict sign on each face",
                        format!("not on the face {which}{}", u8::from(end)),
                    ));
                }
            }
        }
    }
    for a in &whole_s {
        for b in &whole_t {
            if !at_most(&a.hull(), &b.hull(), upper_squared)? {
                return Some(fails(
                    "upper_squared ≥ |p−q|² for all hull points",
                    "a longer difference".into(),
                ));
            }
        }
    }
    Some(Ok(()))
}

/// The curve and D on each of the equal sub-sections of each section.
pub fn restricted<W: Word>(chain: &Chain, pieces: &[Section], subdivisions: u32) -> Option<Vec<HullAndField<W>>> {
    pieces
        .iter()
        .flat_map(|piece| piece.subdivided(subdivisions))
        .map(|piece| section(chain, &piece))
        .collect()
}

/// Is m·v > 0 for all coefficients of D on the sections?
pub fn regular<W: Word>(whole: &[HullAndField<W>], m: &[Integer; 3]) -> Option<bool> {
    let m = vector::<W>(m)?;
    for v in whole.iter().flat_map(|part| &part.fields) {
        if dot(&m, v)? <= W::zero() {
            return Some(false);
        }
    }
    Some(true)
}

/// Is upper_squared ≥ |p−q|² for all points of the two hulls?
pub fn at_most<W: Word>(a: &Hull<'_, W>, b: &Hull<'_, W>, upper_squared: &Rational) -> Option<bool> {
    let gap = Gap::new(a, b)?;
    let common = W::from_integer(&gap.common.value())?;
    let (numerator, denominator) = (
        W::from_integer(upper_squared.numer())?,
        W::from_integer(upper_squared.denom())?,
    );
    gap.all_differences(|x, unit| {
        let unit = unit.times(&common)?;
        Some(dot(x, x)?.times(&denominator)? <= numerator.times(&unit.times(&unit)?)?)
    })
}

/// The sign on one face: negative at the start (`end` false), positive at the end, of (p−q)·(αD(p)+βD(q)), where the fixed point is p, or q if
/// `swapped`: a polynomial along the face, all of whose Bernstein coefficients have that sign.
fn face<W: Word>(
    here: &PointAndField<W>,
    part: &HullAndField<W>,
    factors: &[Integer; 2],
    swapped: bool,
    end: bool,
) -> Option<bool> {
    let (fixed, moving) = if swapped {
        (&factors[1], &factors[0])
    } else {
        (&factors[0], &factors[1])
    };
    let (s, t, _): (W, W, _) = bring_together(here.field_scale.doubled(0), part.field_scale.doubled(0))?;
    let (mut fixed, mut moving) = (W::from_integer(fixed)?.times(&t)?, W::from_integer(moving)?.times(&s)?);
    // The chords below run from the moving point to the fixed one.
    if end == swapped {
        (fixed, moving) = (W::zero().minus(&fixed)?, W::zero().minus(&moving)?);
    }
    let chords = part.chords_to(here)?;
    let fields = part
        .fields
        .iter()
        .map(|w| combine(&fixed, &here.field, &moving, w))
        .collect::<Option<Vec<_>>>()?;
    let (of_chord, of_field) = (binomials::<W>(chords.len())?, binomials::<W>(fields.len())?);
    let mut coefficients = vec![W::zero(); chords.len() + fields.len() - 1];
    for (i, x) in chords.iter().enumerate() {
        for (j, v) in fields.iter().enumerate() {
            let term = dot(x, v)?.times(&of_chord[i].times(&of_field[j])?)?;
            coefficients[i + j] = coefficients[i + j].plus(&term)?;
        }
    }
    Some(coefficients.iter().all(|coefficient| *coefficient > W::zero()))
}

/// The row of Pascal's triangle with `count` entries.
fn binomials<W: Word>(count: usize) -> Option<Vec<W>> {
    let mut row = vec![W::from_i128(1)?];
    while row.len() < count {
        for k in (1..row.len()).rev() {
            row[k] = row[k].plus(&row[k - 1])?;
        }
        row.push(W::from_i128(1)?);
    }
    Some(row)
}
