//! From control points to curves: pieces without length left out, ends welded on demand.

use super::text::{abs, ratio, whole};
use super::{Note, Options};
use crate::curve::{BSpline, Bezier, Curve, CurveError, CurveFault, Form, MAXIMUM_BITS};
use crate::number::{Rational, RationalVector};

/// The coordinates of a point, 2 or 3.
pub(super) type Point = Vec<Rational>;

/// The control points of a piece, affine, and its weights.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct RawPiece {
    pub(super) points: Vec<Point>,
    pub(super) weights: Option<Vec<Rational>>,
}

impl RawPiece {
    /// A polynomial piece.
    pub(super) fn polynomial(points: impl Into<Vec<Point>>) -> RawPiece {
        RawPiece {
            points: points.into(),
            weights: None,
        }
    }

    fn has_no_length(&self) -> bool {
        self.points.windows(2).all(|pair| pair[0] == pair[1])
    }
}

/// A path as a file gives it.
#[derive(Debug, Clone, Default)]
pub(super) struct RawPath {
    pub(super) pieces: Vec<RawPiece>,
    /// Whether the last piece is a line that the file's "close" stands for.
    pub(super) closing_line: bool,
    /// One unit of the last decimal that the file writes.
    pub(super) unit: Option<Rational>,
    /// How many arcs were approximated, and how far they are from the file's.
    pub(super) arcs: usize,
    /// See [`Note::Approximated`].
    pub(super) bound: Option<Rational>,
}

/// The curve of a path, nothing when the path has no length.
pub(super) fn finish(mut path: RawPath, options: &Options) -> Result<Option<(Curve, Vec<Note>)>, CurveError> {
    let mut notes = Vec::new();
    if let Some(bound) = path.bound.take() {
        notes.push(Note::Approximated { arcs: path.arcs, bound });
    }
    let given = path.pieces.len();
    path.pieces.retain(|piece| !piece.has_no_length());
    let dropped = given - path.pieces.len();
    if let Some(miss) = miss(&path) {
        let distance_squared = miss.distance_squared;
        if options.weld {
            path.pieces.truncate(miss.last);
            path.pieces.push(miss.welded);
            notes.push(Note::Welded { distance_squared });
        } else {
            notes.push(Note::Missed { distance_squared });
        }
    }
    if dropped > 0 {
        notes.push(Note::Dropped { pieces: dropped });
    }
    let Some(first) = path.pieces.first() else {
        return Ok(None);
    };
    let dimension = first.points[0].len();
    let pieces: Result<Vec<Bezier>, CurveError> = path.pieces.iter().map(|piece| bezier(dimension, piece)).collect();
    Ok(Some((Curve::new(dimension, Form::Bezier(pieces?))?, notes)))
}

/// An end that misses the start.
struct Miss {
    /// The last piece but for a line that closes the path.
    last: usize,
    /// That piece with its end moved to the start.
    welded: RawPiece,
    distance_squared: Rational,
}

/// Whether the end misses the start by what rounding the file's numbers explains: each piece may miss by half a unit of the last decimal.
fn miss(path: &RawPath) -> Option<Miss> {
    let unit = path.unit.as_ref()?;
    let pieces = i64::try_from(path.pieces.len()).ok()?;
    let most = unit * ratio(pieces.max(2), 2);
    let closing = usize::from(path.closing_line && path.pieces.last().is_some_and(|last| last.points.len() == 2));
    let last = path.pieces.len().checked_sub(1 + closing)?;
    let start = path.pieces.first()?.points.first()?.clone();
    let mut welded = path.pieces[last].clone();
    let end = welded.points.last_mut()?;
    let mut distance_squared = whole(0);
    for (a, b) in start.iter().zip(end.iter()) {
        let difference = a - b;
        if abs(&difference) > most {
            return None;
        }
        distance_squared += &difference * &difference;
    }
    if *end == start {
        return None;
    }
    *end = start;
    // What is as small as rounding is no closed path.
    (!welded.has_no_length()).then_some(Miss {
        last,
        welded,
        distance_squared,
    })
}

/// Numbers over one denominator of bounded size.
fn vector(place: &str, numbers: &[Rational]) -> Result<RationalVector, CurveError> {
    RationalVector::from_rationals_within(numbers, MAXIMUM_BITS).ok_or_else(|| CurveError {
        place: place.to_string(),
        fault: CurveFault::TooManyBits {
            found: MAXIMUM_BITS + 1,
        },
    })
}

fn flat(dimension: usize, points: &[Point]) -> Result<RationalVector, CurveError> {
    if let Some(k) = points.iter().position(|point| point.len() != dimension) {
        return Err(CurveError {
            place: format!("points[{k}]"),
            fault: CurveFault::MixedDimensions {
                found: points[k].len(),
                expected: dimension,
            },
        });
    }
    let numbers: Vec<Rational> = points.iter().flatten().cloned().collect();
    vector("points", &numbers)
}

fn bezier(dimension: usize, piece: &RawPiece) -> Result<Bezier, CurveError> {
    let weights = piece.weights.as_ref().map(|weights| vector("weights", weights));
    Bezier::new(dimension, flat(dimension, &piece.points)?, weights.transpose()?)
}

/// A B-spline or NURBS curve. Weights that are all equal are left out.
pub(super) fn spline(
    degree: usize,
    knots: &[Rational],
    points: &[Point],
    weights: Option<&[Rational]>,
) -> Result<Curve, CurveError> {
    let dimension = points.first().map_or(0, Vec::len);
    let weights = weights.filter(|weights| weights.len() != points.len() || weights.windows(2).any(|w| w[0] != w[1]));
    let weights = weights.map(|weights| vector("weights", weights)).transpose()?;
    let knots = vector("knots", knots)?;
    Ok(BSpline::new(dimension, degree, knots, flat(dimension, points)?, weights)?.into())
}

/// Straight lines from point to point, and back to the first one when closed.
pub(super) fn polygon(points: &[Point], closed: bool) -> Vec<RawPiece> {
    let line = |a: &Point, b: &Point| RawPiece::polynomial([a.clone(), b.clone()]);
    let mut pieces: Vec<RawPiece> = points.windows(2).map(|pair| line(&pair[0], &pair[1])).collect();
    if let (true, [first, .., last]) = (closed && points.len() > 2, points) {
        pieces.push(line(last, first));
    }
    pieces
}

/// C¹ cubic pieces through the points, by the rule of Catmull and Rom (1974): the derivative at a point is half the difference of
/// its neighbours, at open ends the difference to the only neighbour. Points that repeat the one before must not be given.
pub(super) fn catmull_rom(points: &[Point], closed: bool) -> Vec<RawPiece> {
    let n = points.len();
    if n < 2 {
        return Vec::new();
    }
    let closed = closed && n > 2;
    // A third of the derivative.
    let step = |i: usize| -> Point {
        let (before, after) = match closed {
            true => ((i + n - 1) % n, (i + 1) % n),
            false => (i.saturating_sub(1), (i + 1).min(n - 1)),
        };
        let factor = if !closed && (i == 0 || i == n - 1) {
            ratio(1, 3)
        } else {
            ratio(1, 6)
        };
        let difference = points[after]
            .iter()
            .zip(&points[before])
            .map(|(a, b)| (a - b) * &factor);
        difference.collect()
    };
    let steps: Vec<Point> = (0..n).map(step).collect();
    let pieces = if closed { n } else { n - 1 };
    (0..pieces)
        .map(|i| {
            let j = (i + 1) % n;
            let after = points[i].iter().zip(&steps[i]).map(|(p, s)| p + s).collect();
            let before = points[j].iter().zip(&steps[j]).map(|(p, s)| p - s).collect();
            RawPiece::polynomial([points[i].clone(), after, before, points[j].clone()])
        })
        .collect()
}

/// The points without those that repeat the one before; a last one that repeats the first of a closed list goes too.
pub(super) fn without_repetitions(mut points: Vec<Point>, closed: bool) -> (Vec<Point>, usize) {
    let given = points.len();
    points.dedup();
    if closed && points.len() > 1 && points.first() == points.last() {
        points.pop();
    }
    let dropped = given - points.len();
    (points, dropped)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::Joint;

    fn point(x: i64, y: i64) -> Point {
        vec![whole(x), whole(y)]
    }

    #[test]
    fn catmull_rom_is_smooth_and_passes_through() {
        let points = [point(0, 0), point(3, 1), point(4, 5), point(-1, 3)];
        for closed in [false, true] {
            let path = RawPath {
                pieces: catmull_rom(&points, closed),
                ..RawPath::default()
            };
            let (curve, notes) = finish(path, &Options::default()).unwrap().unwrap();
            assert_eq!(notes, []);
            assert_eq!(curve.is_closed(), closed);
            let chain = curve.chain();
            for i in 1..chain.count() {
                assert_eq!(chain.joint(i), Some(Joint::Smooth));
                assert_eq!(chain.evaluate(&whole(i as i64)).unwrap(), points[i]);
            }
        }
    }

    #[test]
    fn welding_is_asked_for_counts_and_stays_within_rounding() {
        let almost = vec![ratio(1, 100), ratio(-1, 100)];
        let mut points = vec![point(0, 0), point(3, 1), point(4, 5), almost.clone()];
        let path = |points: &[Point], closed| RawPath {
            pieces: polygon(points, closed),
            closing_line: closed,
            unit: Some(ratio(1, 100)),
            ..RawPath::default()
        };
        let options = Options {
            weld: true,
            ..Options::default()
        };
        for closed in [false, true] {
            let (left, notes) = finish(path(&points, closed), &Options::default()).unwrap().unwrap();
            assert_eq!(left.is_closed(), closed);
            let distance_squared = ratio(2, 10_000);
            assert_eq!(notes, [Note::Missed { distance_squared }]);
            let (curve, notes) = finish(path(&points, closed), &options).unwrap().unwrap();
            assert!(curve.is_closed());
            assert_eq!(curve.chain().count(), 3);
            assert_eq!(
                notes,
                [Note::Welded {
                    distance_squared: ratio(2, 10_000)
                }]
            );
        }
        points[3] = vec![ratio(3, 100), ratio(0, 1)];
        assert!(!finish(path(&points, false), &options).unwrap().unwrap().0.is_closed());
    }

    #[test]
    fn pieces_without_length_are_counted() {
        let path = RawPath {
            pieces: polygon(&[point(0, 0), point(0, 0), point(1, 0), point(1, 0)], false),
            ..RawPath::default()
        };
        let (curve, notes) = finish(path, &Options::default()).unwrap().unwrap();
        assert_eq!((curve.chain().count(), notes), (1, vec![Note::Dropped { pieces: 2 }]));
        let path = RawPath {
            pieces: polygon(&[point(1, 2), point(1, 2)], false),
            ..RawPath::default()
        };
        assert_eq!(finish(path, &Options::default()), Ok(None));
    }
}
