//! Hull points and tangents of parts as linear functions of the curve's own control points.
//!
//! A row holds the coefficients of such a function: a hull point is Σ r_j P_j / Σ r_j, a tangent a positive multiple of Σ r_j P_j. Rows are
//! split by de Casteljau as the points themselves are, so that they are exact for every part.

use std::collections::HashMap;
use std::rc::Rc;

use crate::check::blossom::interval_values;
use crate::check::chain::{Chain, rational_field_factors};
use crate::check::part::Part;
use crate::curve::{BSpline, Curve, Form};
use crate::number::Integer;

/// The rows of a part.
pub struct Rows {
    /// Of its hull points.
    pub hull: Vec<Vec<Integer>>,
    /// Of its tangents, all with one factor.
    pub tangents: Vec<Vec<Integer>>,
}

/// The control points that a piece depends on.
pub struct Own<'c> {
    /// Number of the first one of them.
    first: usize,
    /// How many.
    pub count: usize,
    /// Coordinates of the first one, in the common list of its kind.
    coordinates: &'c [Integer],
    /// What the coordinates are over.
    pub denominator: &'c Integer,
    /// The number of points that comes round to number 0, on a chain of Bézier pieces that is closed.
    round: usize,
    dimension: usize,
}

impl Own<'_> {
    /// The number of the j-th one. The end of a Bézier piece and the start of the next are one point.
    pub fn number(&self, j: usize) -> usize {
        let number = self.first + j;
        if number == self.round { 0 } else { number }
    }

    /// n·P_j times the denominator, for each.
    pub fn products(&self, n: &[Integer; 3]) -> Vec<Integer> {
        let products = self.coordinates.chunks(self.dimension).take(self.count);
        products
            .map(|point| {
                let terms = point.iter().zip(n).map(|(x, n)| x * n);
                terms.fold(Integer::ZERO, |sum, term| sum + term)
            })
            .collect()
    }
}

/// Which of the two forms a curve has, with what its pieces need.
enum Source<'c> {
    Spline {
        spline: &'c BSpline,
        /// Of each piece: the first of its p+1 control points, and (p+1)² coefficients.
        pieces: Vec<(usize, Vec<Integer>)>,
    },
    Bezier {
        pieces: &'c [crate::curve::Bezier],
        /// Of each piece: the number of its first control point.
        firsts: Vec<usize>,
        round: usize,
    },
}

/// Parts whose rows are remembered.
const REMEMBERED: usize = 1 << 12;

/// The rows of all parts of a curve, made when asked for.
pub struct Table<'c> {
    source: Source<'c>,
    dimension: usize,
    known: HashMap<(usize, u32, u128), Rc<Rows>>,
}

impl<'c> Table<'c> {
    /// A table for a curve and its chain.
    pub fn new(curve: &'c Curve, chain: &Chain) -> Self {
        let source = match curve.form() {
            Form::BSpline(spline) => Source::Spline {
                spline,
                pieces: spline_coefficients(spline),
            },
            Form::Bezier(pieces) => {
                let mut firsts = Vec::with_capacity(pieces.len());
                let mut next = 0;
                for piece in pieces {
                    firsts.push(next);
                    next += piece.degree();
                }
                let round = if chain.closed { next } else { usize::MAX };
                Source::Bezier { pieces, firsts, round }
            }
        };
        Table {
            source,
            dimension: curve.dimension(),
            known: HashMap::new(),
        }
    }

    /// The control points of a piece.
    pub fn own(&self, piece: usize) -> Own<'c> {
        let dimension = self.dimension;
        match &self.source {
            Source::Spline { spline, pieces } => {
                let first = pieces[piece].0;
                Own {
                    first,
                    count: spline.degree() + 1,
                    coordinates: &spline.points().numerators()[first * dimension..],
                    denominator: spline.points().denominator(),
                    round: usize::MAX,
                    dimension,
                }
            }
            Source::Bezier { pieces, firsts, round } => Own {
                first: firsts[piece],
                count: pieces[piece].degree() + 1,
                coordinates: pieces[piece].points().numerators(),
                denominator: pieces[piece].points().denominator(),
                round: *round,
                dimension,
            },
        }
    }

    /// The rows of a part.
    pub fn of_part(&mut self, part: &Part) -> Rc<Rows> {
        self.rows(part.piece, part.depth, part.index)
    }

    /// The rows of a whole piece.
    pub fn of_piece(&mut self, piece: usize) -> Rc<Rows> {
        self.rows(piece, 0, 0)
    }

    /// The rows of the part [index/2^depth, (index+1)/2^depth] of a piece.
    pub fn rows(&mut self, piece: usize, depth: u32, index: u128) -> Rc<Rows> {
        if let Some(rows) = self.known.get(&(piece, depth, index)) {
            return Rc::clone(rows);
        }
        let rows = if depth == 0 {
            self.whole(piece)
        } else {
            let parent = self.rows(piece, depth - 1, index / 2);
            let right = index % 2 == 1;
            Rows {
                hull: half(&parent.hull, right),
                tangents: half(&parent.tangents, right),
            }
        };
        if self.known.len() >= REMEMBERED {
            self.known.clear();
        }
        let rows = Rc::new(rows);
        self.known.insert((piece, depth, index), Rc::clone(&rows));
        rows
    }

    fn whole(&self, piece: usize) -> Rows {
        let hull: Vec<Vec<Integer>> = match &self.source {
            Source::Spline { spline, pieces } => {
                let count = spline.degree() + 1;
                pieces[piece].1.chunks(count).map(<[_]>::to_vec).collect()
            }
            Source::Bezier { pieces, .. } => {
                let piece = &pieces[piece];
                let weight = |k: usize| piece.weights().map_or(Integer::ONE, |w| w.numerators()[k].clone());
                let unit = |k: usize| {
                    let mut row = vec![Integer::ZERO; piece.degree() + 1];
                    row[k] = weight(k);
                    row
                };
                (0..=piece.degree()).map(unit).collect()
            }
        };
        let tangents = field(&hull);
        Rows { hull, tangents }
    }
}

/// For every non-empty knot interval j the number j−p of its first control point, and the coefficients of its Bézier points, weights included.
fn spline_coefficients(spline: &BSpline) -> Vec<(usize, Vec<Integer>)> {
    let p = spline.degree();
    let count = p + 1;
    // Any p+1 control points in a row have different remainders, which are their places in the rows.
    let mut coordinates = vec![Integer::ZERO; spline.count() * count];
    for i in 0..spline.count() {
        coordinates[i * count + i % count] = match spline.weights() {
            None => Integer::ONE,
            Some(weights) => weights.numerators()[i].clone(),
        };
    }
    let knots = spline.knots().numerators();
    let intervals = (p..spline.count()).filter(|j| knots[*j] != knots[*j + 1]);
    let pieces = intervals.zip(interval_values(spline, &coordinates, count));
    pieces
        .map(|(j, (mut values, _))| {
            let first = j - p;
            values.chunks_mut(count).for_each(|row| row.rotate_left(first % count));
            (first, values)
        })
        .collect()
}

/// The sum of a row: the weight of a hull point.
pub fn weight(row: &[Integer]) -> Integer {
    row.iter().fold(Integer::ZERO, |sum, x| sum + x)
}

/// The rows of D (FORMAT §3).
fn field(hull: &[Vec<Integer>]) -> Vec<Vec<Integer>> {
    let weights: Vec<Integer> = hull.iter().map(|row| weight(row)).collect();
    if weights.iter().all(|w| *w == weights[0]) {
        let difference = |pair: &[Vec<Integer>]| pair[1].iter().zip(&pair[0]).map(|(q, p)| q - p).collect();
        return hull.windows(2).map(difference).collect();
    }
    let (factors, _) = rational_field_factors(hull.len() - 1);
    let coefficient = |terms: &Vec<(usize, usize, Integer)>| {
        let mut sum = vec![Integer::ZERO; hull[0].len()];
        for (i, j, factor) in terms {
            let (of_j, of_i) = (factor * &weights[*i], factor * &weights[*j]);
            for (k, entry) in sum.iter_mut().enumerate() {
                *entry = &*entry + &of_j * &hull[*j][k] - &of_i * &hull[*i][k];
            }
        }
        sum
    };
    factors.iter().map(coefficient).collect()
}

/// The rows of the left or right half, times 2^degree.
fn half(rows: &[Vec<Integer>], right: bool) -> Vec<Vec<Integer>> {
    let degree = rows.len() - 1;
    let mut row = rows.to_vec();
    if right {
        row.reverse();
    }
    let mut found = Vec::with_capacity(rows.len());
    for k in 0..=degree {
        let shift = (degree - k) as u32;
        found.push(row[0].iter().map(|x| x << shift).collect::<Vec<_>>());
        for i in 0..degree - k {
            row[i] = row[i].iter().zip(&row[i + 1]).map(|(x, y)| x + y).collect();
        }
    }
    if right {
        found.reverse();
    }
    found
}
