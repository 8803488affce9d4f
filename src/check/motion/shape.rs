//! What stays the same while a curve moves: its pieces, which own control points they depend on, and how.

use super::positions::{MotionError, Positions};
use crate::check::chain::Chain;
use crate::check::embedding::rows::{self, weight};
use crate::check::part::MAX_DEPTH;
use crate::curve::{Curve, Form};
use crate::number::Integer;

/// A node of a cover tree: a run of at least two pieces, or a part of a piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// The pieces `first … last−1`.
    Run {
        /// First piece.
        first: usize,
        /// One past the last piece.
        last: usize,
    },
    /// The part [index/2^depth, (index+1)/2^depth] of a piece.
    Part {
        /// The piece.
        piece: usize,
        /// How many times it was halved.
        depth: u32,
        /// Which of the 2^depth parts.
        index: u128,
    },
}

/// A parameter piece + numerator/2^depth, numerator odd or depth 0.
type Parameter = (usize, u128, u32);

fn parameter(piece: usize, index: u128, depth: u32) -> Parameter {
    let zeros = index.trailing_zeros().min(depth);
    let (numerator, depth) = (index >> zeros, depth - zeros);
    if depth == 0 {
        // Numerator 0 or 1.
        (piece + numerator as usize, 0, 0)
    } else {
        (piece, numerator, depth)
    }
}

impl Node {
    /// The run of the pieces `first … last−1`, or the piece itself if it is one.
    pub fn of_pieces(first: usize, last: usize) -> Node {
        if last - first >= 2 {
            Node::Run { first, last }
        } else {
            let piece = first;
            Node::Part {
                piece,
                depth: 0,
                index: 0,
            }
        }
    }

    /// Its two halves; `None` for a part that was halved too often.
    pub fn halves(&self) -> Option<(Node, Node)> {
        match *self {
            Node::Run { first, last } => {
                let middle = (first + last) / 2;
                Some((Node::of_pieces(first, middle), Node::of_pieces(middle, last)))
            }
            Node::Part { depth, .. } if depth >= MAX_DEPTH => None,
            Node::Part { piece, depth, index } => {
                let half = |index| Node::Part {
                    piece,
                    depth: depth + 1,
                    index,
                };
                Some((half(2 * index), half(2 * index + 1)))
            }
        }
    }

    /// Its pieces, in part or as wholes.
    pub fn pieces(&self) -> std::ops::Range<usize> {
        match *self {
            Node::Run { first, last } => first..last,
            Node::Part { piece, .. } => piece..piece + 1,
        }
    }

    fn start(&self) -> Parameter {
        match *self {
            Node::Run { first, .. } => parameter(first, 0, 0),
            Node::Part { piece, depth, index } => parameter(piece, index, depth),
        }
    }

    fn end(&self) -> Parameter {
        match *self {
            Node::Run { last, .. } => parameter(last, 0, 0),
            Node::Part { piece, depth, index } => parameter(piece, index + 1, depth),
        }
    }
}

impl std::fmt::Display for Node {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match *self {
            Node::Run { first, last } => write!(f, "{} pieces [{first}, {last}]", last - first),
            Node::Part { piece, depth: 0, .. } => write!(f, "piece {piece}"),
            Node::Part { piece, depth, index } => {
                let unit = Integer::ONE << depth;
                let (from, to) = (Integer::from(index as i128), Integer::from(index as i128 + 1));
                write!(f, "piece {piece} part [{from}/{unit}, {to}/{unit}]")
            }
        }
    }
}

/// Rows of coefficients, one after another, of the points that a piece depends on.
#[derive(Clone, Debug)]
pub enum Matrix {
    /// In 64 bits; with the bit length of the greatest sum of magnitudes of a row.
    Narrow(Vec<i64>, u32),
    /// In integers of any size.
    Large(Vec<Integer>),
}

impl Matrix {
    fn new(rows: &[Vec<Integer>]) -> Matrix {
        let narrow: Option<Vec<i64>> = rows.iter().flatten().map(Integer::to_i64).collect();
        let sum = |row: &Vec<Integer>| row.iter().fold(Integer::ZERO, |sum, x| sum + x.abs()).bits();
        let bits = rows.iter().map(sum).max().unwrap_or(0);
        match narrow {
            Some(narrow) if bits <= 62 => Matrix::Narrow(narrow, bits as u32),
            _ => Matrix::Large(rows.iter().flatten().cloned().collect()),
        }
    }
}

/// The hull points and tangents of a part as linear functions of positions in a row.
#[derive(Clone, Debug)]
pub struct PartRows {
    /// The place of the first position.
    pub first: usize,
    /// How many positions.
    pub count: usize,
    /// Hull points times their weights.
    pub hull: Matrix,
    /// The weights of the hull points: one, if all are equal.
    pub weights: Vec<Integer>,
    /// Positive multiples of the D_k; of polynomial pieces left out: there the D_k are the differences of the hull points.
    pub tangents: Option<Matrix>,
}

/// Divides rows by their greatest common factor.
fn reduced(rows: &[Vec<Integer>]) -> Vec<Vec<Integer>> {
    let factor = rows.iter().flatten().fold(Integer::ZERO, |gcd, x| gcd.gcd(x));
    if factor.is_zero() {
        return rows.to_vec();
    }
    let row = |row: &Vec<Integer>| row.iter().map(|x| x.div_exact(&factor)).collect();
    rows.iter().map(row).collect()
}

/// A piece: the positions that it depends on.
#[derive(Clone, Copy, Debug)]
pub struct Piece {
    /// The place of the first.
    pub first: usize,
    /// The place of the last.
    pub last: usize,
    /// Are they its Bézier control points, and is it polynomial?
    pub direct: bool,
}

/// What stays the same.
pub struct Shape<'c> {
    /// The pieces.
    pub pieces: Vec<Piece>,
    /// Do the ends coincide, at every time?
    pub closed: bool,
    /// Are all pieces direct?
    pub direct: bool,
    rows: rows::Table<'c>,
    /// For each place the pieces that depend on it: a range.
    at_place: Vec<(u32, u32)>,
}

impl<'c> Shape<'c> {
    /// The shape of a curve. Of a polygon it is that of its edges as Bézier pieces of degree 1.
    pub fn new(curve: &'c Curve) -> Self {
        let (chain, _) = Chain::with_points(curve);
        let rows = rows::Table::new(curve, &chain);
        let pieces: Vec<Piece> = (0..chain.count())
            .map(|i| {
                let own = rows.own(i);
                let first = own.number(0);
                Piece {
                    first,
                    last: first + own.count - 1,
                    direct: matches!(curve.form(), Form::Bezier(_)) && !chain.pieces[i].rational,
                }
            })
            .collect();
        let places = pieces.iter().map(|piece| piece.last + 1).max().unwrap_or(0);
        let mut at_place = vec![(u32::MAX, 0); places];
        for (i, piece) in pieces.iter().enumerate() {
            for place in &mut at_place[piece.first..=piece.last] {
                *place = (place.0.min(i as u32), i as u32 + 1);
            }
        }
        Shape {
            direct: pieces.iter().all(|piece| piece.direct),
            pieces,
            closed: chain.closed,
            rows,
            at_place,
        }
    }

    /// The node of all pieces.
    pub fn whole(&self) -> Node {
        Node::of_pieces(0, self.pieces.len())
    }

    /// The pieces that depend on a place.
    pub fn pieces_at(&self, place: usize) -> std::ops::Range<usize> {
        match self.at_place.get(place) {
            Some((first, last)) if first < last => *first as usize..*last as usize,
            _ => 0..0,
        }
    }

    /// Do two different nodes, `a` before `b`, share an end parameter?
    pub fn adjacent(&self, a: &Node, b: &Node) -> bool {
        a.end() == b.start() || self.closed && a.start() == (0, 0, 0) && b.end() == (self.pieces.len(), 0, 0)
    }

    /// The places that a node depends on.
    pub fn places(&self, node: &Node) -> std::ops::RangeInclusive<usize> {
        let pieces = node.pieces();
        self.pieces[pieces.start].first..=self.pieces[pieces.end - 1].last
    }

    /// The rows of a part.
    pub fn part_rows(&mut self, piece: usize, depth: u32, index: u128) -> PartRows {
        let rows = self.rows.rows(piece, depth, index);
        let Piece { first, last, .. } = self.pieces[piece];
        let hull = reduced(&rows.hull);
        let mut weights: Vec<Integer> = hull.iter().map(|row| weight(row)).collect();
        let polynomial = weights.iter().all(|w| *w == weights[0]);
        if polynomial {
            weights.truncate(1);
        }
        let each = |row: &Vec<Integer>| reduced(std::slice::from_ref(row)).remove(0);
        let tangents = || Matrix::new(&rows.tangents.iter().map(each).collect::<Vec<_>>());
        PartRows {
            first,
            count: last - first + 1,
            hull: Matrix::new(&hull),
            weights,
            tangents: (!polynomial).then(tangents),
        }
    }

    /// Fails if the ends of a closed curve are apart at these positions.
    ///
    /// # Errors
    /// [`MotionError::Opens`].
    pub fn stays_closed(&mut self, positions: &Positions) -> Result<(), MotionError> {
        if !self.closed {
            return Ok(());
        }
        let end = |shape: &mut Shape, piece: usize, last: bool| {
            let rows = shape.rows.rows(piece, 0, 0);
            let row = if last { rows.hull.last() } else { rows.hull.first() };
            let row = row.expect("a piece has hull points");
            let mut sum: [Integer; 3] = Default::default();
            for (j, factor) in row.iter().enumerate().filter(|(_, factor)| !factor.is_zero()) {
                let position = positions.get(shape.pieces[piece].first + j);
                for axis in 0..3 {
                    sum[axis] = &sum[axis] + &position[axis] * factor;
                }
            }
            (sum, weight(row))
        };
        let ((p, v), (q, w)) = (end(self, 0, false), end(self, self.pieces.len() - 1, true));
        if (0..3).all(|axis| &p[axis] * &w == &q[axis] * &v) {
            Ok(())
        } else {
            Err(MotionError::Opens)
        }
    }
}
