//! The intersection of a list of half-spaces, with every outcome.

use super::body::Body;
use super::duplicate::{Indexed, without_duplicates};
use super::{Clip, Flat, HalfSpace, Intersection, Polytope, ZERO};
use crate::number::{Integer, Rational};

/// The intersection of half-spaces in the plane (D = 2) or in space (D = 3), exact for integers of any size.
///
/// Facets name their rows by index. Of rows that are equal up to a positive factor the first counts; a row that contains the intersection of the
/// others is no facet, nor is a row with a zero normal, which at most makes the intersection empty. No rows at all leave the whole space: unbounded.
///
/// The expected time for n rows and v vertices is of the order n·v in binary64 plus little beyond it.
pub fn intersect<const D: usize>(rows: &[HalfSpace<D>]) -> Intersection<D> {
    let indexed: Vec<Indexed> = rows.iter().map(HalfSpace::coefficients).enumerate().collect();
    let point = |point: [Rational; 3]| {
        let mut point = point.into_iter();
        std::array::from_fn(|_| point.next().unwrap_or_default())
    };
    match solve(&indexed, D) {
        Outcome::Empty => Intersection::Empty,
        Outcome::Full { body, bounded: true } => Intersection::Bounded(Polytope { body }),
        Outcome::Full { .. } | Outcome::Interval { .. } => Intersection::Unbounded,
        Outcome::Flat(flat) => Intersection::Flat(Flat {
            dimension: flat.dimension,
            point: point(flat.point),
            bounded: flat.bounded,
        }),
    }
}

/// An intersection in dimension 1, 2 or 3; coordinates beyond the dimension are 0.
enum Outcome {
    Empty,
    Flat(Flat<3>),
    /// In dimension 1: an interval with interior.
    Interval {
        point: Rational,
        bounded: bool,
    },
    /// In dimensions 2 and 3.
    Full {
        body: Box<Body>,
        bounded: bool,
    },
}

/// Intersects rows whose coefficients from `dimension` to 2 are zero.
fn solve(rows: &[Indexed], dimension: usize) -> Outcome {
    let mut proper = Vec::with_capacity(rows.len());
    let mut sides: [[Option<Indexed>; 2]; 3] = Default::default();
    let mut bits = 1;
    for row in rows {
        let normal = &row.1[..dimension];
        bits = row
            .1
            .iter()
            .fold(bits, |bits, coefficient| bits.max(coefficient.bits()));
        let mut axes = (0..dimension).filter(|i| !normal[*i].is_zero());
        match (axes.next(), axes.next()) {
            (None, _) if row.1[3].is_negative() => return Outcome::Empty,
            (None, _) => {}
            (Some(axis), None) => {
                let side = &mut sides[axis][usize::from(normal[axis].is_negative())];
                if side.is_none_or(|side| distance(&row.1, axis) < distance(&side.1, axis)) {
                    *side = Some(*row);
                }
            }
            _ => proper.push(*row),
        }
    }
    for axis in 0..dimension {
        if let [Some(low), Some(high)] = &sides[axis] {
            // Distances of the origin from both sides: their sum is the width.
            let width = distance(&low.1, axis) + distance(&high.1, axis);
            if width.numer().is_negative() {
                return Outcome::Empty;
            }
            if width.numer().is_zero() {
                return flat(low.1, rows, dimension);
            }
        }
    }
    if dimension == 1 {
        return interval(&sides[0]);
    }
    // The coordinates of an intersection's vertices, or of some point of it when it has none, are quotients of determinants, less than 3! · 2^(3 · bits)
    // over at least 1. So where a side is missing, one so far away changes neither whether the intersection is empty or has interior, nor a vertex;
    // and it becomes a facet just when the intersection is unbounded.
    let far = Integer::ONE << (3 * bits + 4) as u32;
    let mut first = Vec::with_capacity(2 * dimension);
    for axis in 0..dimension {
        for (side, one) in sides[axis].iter().zip([1, -1]) {
            first.push(match side {
                Some((index, row)) => (row.map(Integer::clone), Some(*index)),
                None => {
                    let mut row = [const { Integer::ZERO }; 4];
                    row[axis] = Integer::from(one);
                    row[3] = far.clone();
                    (row, None)
                }
            });
        }
    }
    let mut body = Body::from_sides(&first, dimension);
    let mut proper = without_duplicates(&proper);
    shuffle(&mut proper);
    for (index, row) in proper {
        match body.clip(row, Some(index)) {
            Clip::Redundant | Clip::Cut => {}
            Clip::Empty => return Outcome::Empty,
            // Everything is on one side of this row's hyperplane, so the intersection lies in it.
            Clip::Flat => return flat(row, rows, dimension),
        }
    }
    let bounded = body
        .facets
        .iter()
        .all(|facet| body.rows[facet.row as usize].label.is_some());
    Outcome::Full {
        body: Box::new(body),
        bounded,
    }
}

/// For a row along one axis: the distance of the origin from its boundary, positive inside.
fn distance(row: &[&Integer; 4], axis: usize) -> Rational {
    Rational::new(row[3].clone(), row[axis].abs())
}

fn interval([low, high]: &[Option<Indexed>; 2]) -> Outcome {
    let end = |side: &Option<Indexed>| side.map(|(_, row)| distance(&row, 0));
    let one = Rational::from_integer(Integer::ONE);
    let two = Rational::from_integer(Integer::from(2));
    let (low, high) = (end(low).map(|low| -low), end(high));
    let bounded = low.is_some() && high.is_some();
    let point = match (low, high) {
        (Some(low), Some(high)) => (low + high) / two,
        (Some(low), None) => low + one,
        (None, Some(high)) => high - one,
        (None, None) => Rational::default(),
    };
    Outcome::Interval { point, bounded }
}

/// The intersection of rows, known to lie in the hyperplane of one of them, by elimination of a coordinate.
fn flat(plane: [&Integer; 4], rows: &[Indexed], dimension: usize) -> Outcome {
    let Some(axis) = (0..dimension).find(|i| !plane[*i].is_zero()) else {
        return Outcome::Empty;
    };
    let pivot = plane[axis].abs();
    let others: Vec<usize> = (0..dimension).filter(|i| *i != axis).chain([3]).collect();
    let eliminated: Vec<(usize, Vec<Integer>)> = rows
        .iter()
        .map(|(index, row)| {
            let factor = if plane[axis].is_negative() {
                -row[axis]
            } else {
                row[axis].clone()
            };
            let row = others.iter().map(|&i| &pivot * row[i] - &factor * plane[i]).collect();
            (*index, row)
        })
        .collect();
    let lower: Vec<Indexed> = eliminated
        .iter()
        .map(|(index, row)| {
            let mut coefficients = [&ZERO; 4];
            let (constant, normal) = row.split_last().unwrap_or((&ZERO, &[]));
            for (coefficient, value) in coefficients.iter_mut().zip(normal) {
                *coefficient = value;
            }
            coefficients[3] = constant;
            (*index, coefficients)
        })
        .collect();
    let (below, point, bounded) = if dimension == 1 {
        // The hyperplane is a point; what is left of the rows are their values there.
        if lower.iter().any(|(_, row)| row[3].is_negative()) {
            return Outcome::Empty;
        }
        (0, Default::default(), true)
    } else {
        match solve(&lower, dimension - 1) {
            Outcome::Empty => return Outcome::Empty,
            Outcome::Flat(flat) => (flat.dimension, flat.point, flat.bounded),
            Outcome::Interval { point, bounded } => (1, [point, Rational::default(), Rational::default()], bounded),
            Outcome::Full { body, bounded } => (dimension - 1, body.interior_point(), bounded),
        }
    };
    // Back to this dimension: the coordinate that was eliminated follows from the others.
    let mut full: [Rational; 3] = Default::default();
    for (&i, coordinate) in others.iter().filter(|i| **i != 3).zip(point) {
        full[i] = coordinate;
    }
    let value = (0..3).fold(Rational::from_integer(plane[3].clone()), |value, i| {
        value + &full[i] * plane[i]
    });
    full[axis] = -value / plane[axis];
    Outcome::Flat(Flat {
        dimension: below,
        point: full,
        bounded,
    })
}

/// A fixed permutation without pattern: in a random order few rows cut that are no facets at the end.
fn shuffle<T>(items: &mut [T]) {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    for i in (1..items.len()).rev() {
        // Steele, Lea, Flood 2014: SplitMix64.
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^= mixed >> 31;
        items.swap(i, (mixed % (i as u64 + 1)) as usize);
    }
}
