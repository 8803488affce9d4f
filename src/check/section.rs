//! Points of the chain at rational parameters, and sections of it between them (FORMAT §6).

use std::borrow::Cow;
use std::cmp::Ordering;

use super::chain::{Chain, OwnedNumbers, Scale, convert, convert_one};
use super::hull::{Hull, bring_together};
use super::word::{Word, combine};
use crate::claim::msd::{Interval, Side};
use crate::number::{Integer, Rational};

/// A parameter on a certain piece, u ∈ [0, 1] local.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Location {
    /// The piece.
    pub piece: usize,
    /// The local parameter.
    pub local: Rational,
}

/// A piece between two local parameters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Section {
    /// The piece.
    pub piece: usize,
    /// Start, 0 ≤ start < end.
    pub start: Rational,
    /// End, at most 1.
    pub end: Rational,
}

fn whole_part(s: &Rational) -> Integer {
    s.numer().div_floor(s.denom())
}

/// Is `s` a parameter of the chain: 0 ≤ s ≤ M, and not M on a closed one?
pub fn is_parameter(chain: &Chain, s: &Rational) -> bool {
    let end = Rational::from_integer(chain.count().into());
    !s.numer().is_negative() && if chain.closed { *s < end } else { *s <= end }
}

/// The joint at an integer parameter of the chain (M is 0 when closed): its number, with the pieces before and after it where there
/// are such.
pub fn joint_pieces(chain: &Chain, joint: usize) -> (Option<usize>, Option<usize>) {
    let count = chain.count();
    if joint > count {
        return (None, None);
    }
    let before = if joint > 0 {
        Some(joint - 1)
    } else {
        chain.closed.then(|| count - 1)
    };
    let after = if joint < count {
        Some(joint)
    } else {
        chain.closed.then_some(0)
    };
    (before, after)
}

/// The integer parameter `s` is, if it is one.
pub fn as_joint(s: &Rational) -> Option<usize> {
    if s.is_integer() {
        usize::try_from(s.numer().to_u64()?).ok()
    } else {
        None
    }
}

/// Where a parameter lies, seen from a side; `None` when there is no piece on that side.
pub fn locate(chain: &Chain, s: &Rational, side: Side) -> Option<Location> {
    if let Some(joint) = as_joint(s) {
        let (before, after) = joint_pieces(chain, joint);
        return match side {
            Side::Before => Some(Location {
                piece: before?,
                local: Rational::from_integer(1.into()),
            }),
            Side::After => Some(Location {
                piece: after?,
                local: Rational::from_integer(0.into()),
            }),
        };
    }
    let piece = whole_part(s);
    let local = s - Rational::from_integer(piece.clone());
    let piece = usize::try_from(piece.to_u64()?)
        .ok()
        .filter(|piece| *piece < chain.count())?;
    Some(Location { piece, local })
}

/// The sections of an interval, and the joint strictly inside it, if any.
pub fn sections(chain: &Chain, interval: &Interval) -> Option<(Vec<Section>, Option<usize>)> {
    let (start, end) = (&interval.start, &interval.end);
    let one = Rational::from_integer(1.into());
    let count = Rational::from_integer(chain.count().into());
    if start.numer().is_negative()
        || *start >= count
        || start >= end
        || end - start > one
        || (!chain.closed && *end > count)
    {
        return None;
    }
    let first = usize::try_from(whole_part(start).to_u64()?).ok()?;
    let base = Rational::from_integer(first.into());
    let (from, to) = (start - &base, end - &base);
    if to <= one {
        return Some((
            vec![Section {
                piece: first,
                start: from,
                end: to,
            }],
            None,
        ));
    }
    let next = (first + 1) % chain.count();
    let zero = Rational::from_integer(0.into());
    let before = Section {
        piece: first,
        start: from,
        end: one.clone(),
    };
    let after = Section {
        piece: next,
        start: zero,
        end: to - one,
    };
    Some((vec![before, after], Some(next)))
}

/// Is the joint smooth?
pub fn smooth_at(chain: &Chain, joint: usize) -> bool {
    match joint_pieces(chain, joint) {
        (Some(before), Some(after)) => chain.smooth_joint(before, after),
        _ => false,
    }
}

impl Section {
    /// The `count` equal sub-sections.
    pub fn subdivided(&self, count: u32) -> Vec<Section> {
        let step = (&self.end - &self.start) / Rational::from_integer(count.into());
        let at = |i: u32| &self.start + &step * Rational::from_integer(i.into());
        (0..count)
            .map(|i| Section {
                piece: self.piece,
                start: at(i),
                end: at(i + 1),
            })
            .collect()
    }

    fn start_location(&self) -> Location {
        Location {
            piece: self.piece,
            local: self.start.clone(),
        }
    }

    fn end_location(&self) -> Location {
        Location {
            piece: self.piece,
            local: self.end.clone(),
        }
    }
}

/// The location where a list of sections starts, or ends.
pub fn end_of(sections: &[Section], end: bool) -> Location {
    if end {
        sections[sections.len() - 1].end_location()
    } else {
        sections[0].start_location()
    }
}

/// A point of the curve and D there.
pub struct PointAndField<W> {
    point: Vec<[W; 3]>,
    weights: Vec<W>,
    point_scale: Scale,
    /// D.
    pub field: [W; 3],
    /// What D is over.
    pub field_scale: Scale,
}

impl<W: Word> PointAndField<W> {
    /// The point, as a hull of one point.
    pub fn hull(&self) -> Hull<'_, W> {
        Hull::of_points(
            Cow::Borrowed(&self.point),
            self.weights.clone(),
            self.point_scale.doubled(0),
        )
    }
}

/// A section's hull and field coefficients.
pub struct HullAndField<W> {
    points: Vec<[W; 3]>,
    weights: Vec<W>,
    point_scale: Scale,
    /// Coefficients of D on the section, zero vectors included.
    pub fields: Vec<[W; 3]>,
    /// What they are over.
    pub field_scale: Scale,
}

impl<W: Word> HullAndField<W> {
    /// The control points of the section.
    pub fn hull(&self) -> Hull<'_, W> {
        Hull::of_points(
            Cow::Borrowed(&self.points),
            self.weights.clone(),
            self.point_scale.doubled(0),
        )
    }

    /// The Bernstein coefficients of w·(p − c) on the section, up to one positive factor: p is the point `to`, w the weight of c.
    pub fn chords_to(&self, to: &PointAndField<W>) -> Option<Vec<[W; 3]>> {
        // Both points are numerators over a weight; where a whole section has one weight, what it shares with the other one cancels.
        let (weight, weights) = match (to.weights.first(), self.weights.is_empty()) {
            (None, true) => {
                let (of_point, of_section, _) = bring_together(to.point_scale.doubled(0), self.point_scale.doubled(0))?;
                (of_point, vec![of_section])
            }
            (Some(weight), true) => (weight.clone(), vec![W::from_integer(&self.point_scale.value())?]),
            (None, false) => (W::from_integer(&to.point_scale.value())?, self.weights.clone()),
            (Some(weight), false) => (weight.clone(), self.weights.clone()),
        };
        let minus = W::zero().minus(&weight)?;
        self.points
            .iter()
            .enumerate()
            .map(|(k, q)| combine(&weights[k.min(weights.len() - 1)], &to.point[0], &minus, q))
            .collect()
    }
}

/// The common denominator b of some parameters, and their numerators over it.
fn numerators(parameters: &[&Rational]) -> (Integer, Vec<Integer>) {
    let denominator = parameters.iter().fold(Integer::from(1), |lcm, u| lcm.lcm(u.denom()));
    let over = parameters
        .iter()
        .map(|u| u.numer() * denominator.div_exact(u.denom()))
        .collect();
    (denominator, over)
}

fn scaled(scale: &Scale, denominator: &Integer, degree: usize) -> Scale {
    Scale::new(&(scale.value() * denominator.pow(degree as u32)))
}

/// b^degree times the blossom at the given arguments, each a numerator over b.
fn blossom<W: Word>(coefficients: &[[W; 3]], arguments: &[&W], denominator: &W) -> Option<[W; 3]> {
    let mut row = coefficients.to_vec();
    for argument in arguments {
        let rest = denominator.minus(argument)?;
        for i in 0..row.len() - 1 {
            row[i] = combine(&rest, &row[i], argument, &row[i + 1])?;
        }
        row.pop();
    }
    row.into_iter().next()
}

/// The Bernstein coefficients between two numerators over b, each times b^degree.
fn restricted<W: Word>(coefficients: &[[W; 3]], start: &W, end: &W, denominator: &W) -> Option<Vec<[W; 3]>> {
    let degree = coefficients.len() - 1;
    (0..=degree)
        .map(|k| {
            let arguments: Vec<&W> = (0..degree).map(|i| if i < degree - k { start } else { end }).collect();
            blossom(coefficients, &arguments, denominator)
        })
        .collect()
}

fn first_axis<W>(vectors: Vec<[W; 3]>) -> Vec<W> {
    vectors.into_iter().map(|[x, _, _]| x).collect()
}

fn on_first_axis<W: Word>(numbers: &[W]) -> Vec<[W; 3]> {
    numbers.iter().map(|x| [x.clone(), W::zero(), W::zero()]).collect()
}

/// The curve between two local parameters of a piece.
pub fn section<W: Word>(chain: &Chain, section: &Section) -> Option<HullAndField<W>> {
    // Mostly 128 bits suffice here, if not for the products that follow.
    match section_in::<i128>(chain, section) {
        Some(narrow) => Some(HullAndField {
            points: narrow.points.iter().map(convert).collect::<Option<_>>()?,
            weights: narrow.weights.iter().map(convert_one).collect::<Option<_>>()?,
            fields: narrow.fields.iter().map(convert).collect::<Option<_>>()?,
            point_scale: narrow.point_scale,
            field_scale: narrow.field_scale,
        }),
        None => section_in(chain, section),
    }
}

fn section_in<W: Word>(chain: &Chain, section: &Section) -> Option<HullAndField<W>> {
    let piece = &chain.pieces[section.piece];
    let numbers: OwnedNumbers<W> = chain.numbers_as(section.piece)?;
    let (denominator, over) = numerators(&[&section.start, &section.end]);
    let (b, start, end) = (
        W::from_integer(&denominator)?,
        W::from_integer(&over[0])?,
        W::from_integer(&over[1])?,
    );
    let weights = match numbers.weights.is_empty() {
        true => Vec::new(),
        false => first_axis(restricted(&on_first_axis(&numbers.weights), &start, &end, &b)?),
    };
    Some(HullAndField {
        points: restricted(&numbers.points, &start, &end, &b)?,
        weights,
        point_scale: scaled(&piece.point_scale, &denominator, piece.degree),
        fields: restricted(&numbers.tangents, &start, &end, &b)?,
        field_scale: scaled(&piece.tangent_scale, &denominator, piece.tangent_degree),
    })
}

/// The curve and D at a local parameter of a piece.
pub fn point<W: Word>(chain: &Chain, location: &Location) -> Option<PointAndField<W>> {
    match point_in::<i128>(chain, location) {
        Some(narrow) => Some(PointAndField {
            point: narrow.point.iter().map(convert).collect::<Option<_>>()?,
            weights: narrow.weights.iter().map(convert_one).collect::<Option<_>>()?,
            field: convert(&narrow.field)?,
            point_scale: narrow.point_scale,
            field_scale: narrow.field_scale,
        }),
        None => point_in(chain, location),
    }
}

fn point_in<W: Word>(chain: &Chain, location: &Location) -> Option<PointAndField<W>> {
    let piece = &chain.pieces[location.piece];
    let numbers: OwnedNumbers<W> = chain.numbers_as(location.piece)?;
    let (denominator, over) = numerators(&[&location.local]);
    let (b, u) = (W::from_integer(&denominator)?, W::from_integer(&over[0])?);
    let here = |coefficients: &[[W; 3]]| blossom(coefficients, &vec![&u; coefficients.len() - 1], &b);
    let weights = match numbers.weights.is_empty() {
        true => Vec::new(),
        false => first_axis(vec![here(&on_first_axis(&numbers.weights))?]),
    };
    Some(PointAndField {
        point: vec![here(&numbers.points)?],
        weights,
        point_scale: scaled(&piece.point_scale, &denominator, piece.degree),
        field: here(&numbers.tangents)?,
        field_scale: scaled(&piece.tangent_scale, &denominator, piece.tangent_degree),
    })
}

/// The tangent direction at a location: D, or where D vanishes at an end of the piece the outgoing or incoming direction there. `None`
/// where D vanishes inside.
pub fn direction(chain: &Chain, location: &Location) -> Option<[Integer; 3]> {
    let here: PointAndField<Integer> = point(chain, location).expect("unbounded integers do not overflow");
    if here.field.iter().any(|x| x.sign() != Ordering::Equal) {
        return Some(here.field);
    }
    match as_joint(&location.local) {
        Some(0) => Some(chain.end_direction(location.piece, false)),
        Some(_) => Some(chain.end_direction(location.piece, true)),
        None => None,
    }
}

/// Are two intervals in order and apart, also across the closing point?
pub fn apart(chain: &Chain, first: &Interval, second: &Interval) -> bool {
    let period = Rational::from_integer(chain.count().into());
    first.end < second.start && (!chain.closed || second.end < &first.start + period)
}
