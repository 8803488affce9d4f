//! ν: the least distance of a vertex of a polygon from an edge that does not end in it.

use super::positions::Positions;
use super::shape::Shape;
use crate::check::word::{Word, dot, vector, widening};
use crate::number::{Integer, Rational};

/// The most edges for which ν is computed; the work grows with their square.
pub const MOST_EDGES: usize = 4096;

/// The square of the distance of p from the segment from a to b, as a numerator and a positive denominator.
fn squared_distance<W: Word>(p: &[W; 3], a: &[W; 3], b: &[W; 3]) -> Option<(W, W)> {
    let minus = |x: &[W; 3], y: &[W; 3]| Some([x[0].minus(&y[0])?, x[1].minus(&y[1])?, x[2].minus(&y[2])?]);
    let (along, from) = (minus(b, a)?, minus(p, a)?);
    let (square, t) = (dot(&along, &along)?, dot(&along, &from)?);
    let one = W::from_i128(1)?;
    if t <= W::zero() {
        return Some((dot(&from, &from)?, one));
    }
    if t >= square {
        let from = minus(p, b)?;
        return Some((dot(&from, &from)?, one));
    }
    Some((dot(&from, &from)?.times(&square)?.minus(&t.times(&t)?)?, square))
}

/// At most the square of the distance of p from the segment from a to b: that from the box around it.
fn below<W: Word>(p: &[W; 3], a: &[W; 3], b: &[W; 3]) -> Option<W> {
    let mut sum = W::zero();
    for axis in 0..3 {
        let (low, high) = (
            a[axis].clone().min(b[axis].clone()),
            a[axis].clone().max(b[axis].clone()),
        );
        let out = low.minus(&p[axis])?.max(p[axis].minus(&high)?).max(W::zero());
        sum = sum.plus(&out.times(&out)?)?;
    }
    Some(sum)
}

fn least<W: Word>(points: &[[Integer; 3]], edges: usize, closed: bool) -> Option<Option<(Integer, Integer)>> {
    let points: Vec<[W; 3]> = points.iter().map(vector).collect::<Option<_>>()?;
    let vertices = if closed { edges } else { edges + 1 };
    let mut least: Option<(W, W)> = None;
    for (i, p) in points[..vertices].iter().enumerate() {
        for j in 0..edges {
            let next = if j + 1 == vertices { 0 } else { j + 1 };
            if i == j || i == next {
                continue;
            }
            let (a, b) = (&points[j], &points[next]);
            let Some((numerator, denominator)) = &least else {
                least = Some(squared_distance(p, a, b)?);
                continue;
            };
            if below(p, a, b)?.times(denominator)? >= *numerator {
                continue;
            }
            let found = squared_distance(p, a, b)?;
            if found.0.times(denominator)? < numerator.times(&found.1)? {
                least = Some(found);
            }
        }
    }
    Some(least.map(|(numerator, denominator)| (numerator.to_integer(), denominator.to_integer())))
}

/// ν² of a polygon; `None` if it has too many edges, or no vertex and edge apart.
pub fn nu_squared(polygon: &Shape, positions: &Positions, denominator: &Integer) -> Option<Rational> {
    let edges = polygon.pieces.len();
    if edges > MOST_EDGES {
        return None;
    }
    let points: Vec<[Integer; 3]> = (0..=edges).map(|place| positions.get(place)).collect();
    let (numerator, below) = widening!(64, W => least::<W>(&points, edges, polygon.closed))?;
    Some(Rational::new(numerator, below * denominator * denominator))
}
