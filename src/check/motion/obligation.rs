//! The obligations of the two rules at given positions, in any width (FORMAT §14).

use std::cmp::Ordering;

use super::parts::Known;
use super::positions::Positions;
use super::runs::Bounds;
use super::shape::{Matrix, Node, PartRows, Shape};
use crate::check::rule::{Failure, Outcome};
use crate::check::word::{Word, dot, vector, widening};
use crate::claim::tree::Leaf;
use crate::number::Integer;

/// What a node's hull points, or the D_k of a piece, are computed from.
#[derive(Clone, Copy)]
pub enum Points<'p> {
    /// A box of a run.
    Bounds(&'p Bounds),
    /// The box around positions in a row.
    Span(usize, usize),
    /// Positions in a row: the control points of a polynomial piece.
    Direct(usize, usize),
    /// A part.
    Part(&'p PartRows),
    /// A polynomial part whose hull points are known.
    Known(Known<'p>),
}

fn narrow<W: Word>(point: &[i64; 3]) -> Option<[W; 3]> {
    let [x, y, z] = point.map(|x| W::from_i128(i128::from(x)));
    Some([x?, y?, z?])
}

fn position<W: Word>(positions: &Positions, place: usize) -> Option<[W; 3]> {
    match positions.narrow() {
        Some(points) => narrow(&points[place]),
        None => vector(&positions.get(place)),
    }
}

/// Σ r_j P_j for every row.
fn product<W: Word>(matrix: &Matrix, rows: &PartRows, positions: &Positions) -> Option<Vec<[W; 3]>> {
    let points: Vec<[W; 3]> = (rows.first..rows.first + rows.count)
        .map(|place| position(positions, place))
        .collect::<Option<_>>()?;
    let sum = |row: Vec<W>| {
        let mut sum = [W::zero(), W::zero(), W::zero()];
        for (factor, point) in row.iter().zip(&points) {
            for axis in 0..3 {
                sum[axis] = sum[axis].plus(&factor.times(&point[axis])?)?;
            }
        }
        Some(sum)
    };
    match matrix {
        Matrix::Narrow(entries, _) => entries
            .chunks(rows.count)
            .map(|row| {
                let row = row.iter().map(|x| W::from_i128(i128::from(*x)));
                sum(row.collect::<Option<_>>()?)
            })
            .collect(),
        Matrix::Large(entries) => entries
            .chunks(rows.count)
            .map(|row| sum(row.iter().map(W::from_integer).collect::<Option<_>>()?))
            .collect(),
    }
}

impl Points<'_> {
    /// Hull points times their weights.
    fn hull<W: Word>(&self, positions: &Positions) -> Option<Vec<[W; 3]>> {
        match *self {
            Points::Bounds(bounds) => {
                let corner = |i: usize| {
                    [
                        bounds[3 * (i & 1)],
                        bounds[3 * (i >> 1 & 1) + 1],
                        bounds[3 * (i >> 2) + 2],
                    ]
                };
                (0..8).map(|i| narrow(&corner(i))).collect()
            }
            Points::Span(first, last) => {
                let (mut least, mut greatest): ([W; 3], [W; 3]) =
                    (position(positions, first)?, position(positions, first)?);
                for place in first + 1..=last {
                    let point: [W; 3] = position(positions, place)?;
                    for axis in 0..3 {
                        if point[axis] < least[axis] {
                            least[axis] = point[axis].clone();
                        } else if point[axis] > greatest[axis] {
                            greatest[axis] = point[axis].clone();
                        }
                    }
                }
                let ends = [least, greatest];
                let corner = |i: usize| [0, 1, 2].map(|axis| ends[i >> axis & 1][axis].clone());
                Some((0..8).map(corner).collect())
            }
            Points::Direct(first, last) => (first..=last).map(|place| position(positions, place)).collect(),
            Points::Known(known) => known.points.iter().map(narrow).collect(),
            Points::Part(rows) => product(&rows.hull, rows, positions),
        }
    }

    /// The weights of the hull points, one if they are equal.
    fn weights<W: Word>(&self) -> Option<Vec<W>> {
        match self {
            Points::Part(rows) => rows.weights.iter().map(W::from_integer).collect(),
            Points::Known(known) => Some(vec![W::from_i128(i128::from(known.weight))?]),
            _ => Some(vec![W::from_i128(1)?]),
        }
    }

    /// n·p of the hull points, each over its weight; only the least one (or greatest one) where the weights are equal.
    fn products<W: Word>(&self, positions: &Positions, n: &[W; 3], greatest: bool) -> Option<Vec<(W, W)>> {
        let weights = self.weights::<W>()?;
        let points = self.hull::<W>(positions)?;
        let products: Vec<W> = points.iter().map(|point| dot(n, point)).collect::<Option<_>>()?;
        if weights.len() > 1 {
            return Some(products.into_iter().zip(weights).collect());
        }
        let best = if greatest {
            products.into_iter().max()
        } else {
            products.into_iter().min()
        };
        best.into_iter().zip(weights).map(Some).collect()
    }

    /// Is every D_k zero or n·D_k > 0, and not all of them zero?
    fn forward<W: Word>(&self, positions: &Positions, n: &[W; 3]) -> Option<bool> {
        let vectors: Vec<[W; 3]> = match self {
            Points::Part(rows) if rows.tangents.is_some() => match &rows.tangents {
                Some(tangents) => product(tangents, rows, positions)?,
                None => Vec::new(),
            },
            _ => {
                let hull = self.hull::<W>(positions)?;
                let difference = |pair: &[[W; 3]]| {
                    let (p, q) = (&pair[0], &pair[1]);
                    Some([q[0].minus(&p[0])?, q[1].minus(&p[1])?, q[2].minus(&p[2])?])
                };
                hull.windows(2).map(difference).collect::<Option<_>>()?
            }
        };
        let mut moves = false;
        for v in vectors.iter().filter(|v| !v.iter().all(W::vanishes)) {
            if dot(n, v)?.sign() != Ordering::Greater {
                return Some(false);
            }
            moves = true;
        }
        Some(moves)
    }
}

fn apart<W: Word>(a: Points, b: Points, positions: &Positions, n: &[Integer; 3]) -> Option<bool> {
    let n = vector::<W>(n)?;
    let low = a.products(positions, &n, false)?;
    let high = b.products(positions, &n, true)?;
    for (x, v) in &low {
        for (y, w) in &high {
            if x.times(w)? <= y.times(v)? {
                return Some(false);
            }
        }
    }
    Some(true)
}

/// Is n·p > n·q for all hull points p of A, q of B?
pub fn separated(a: Points, b: Points, positions: &Positions, n: &[Integer; 3]) -> bool {
    widening!(0, W => apart::<W>(a, b, positions, n))
}

/// Does a piece or part go strictly in the direction n?
pub fn goes(points: Points, positions: &Positions, n: &[Integer; 3]) -> bool {
    widening!(0, W => (|| points.forward(positions, &vector::<W>(n)?))())
}

fn fails(expected: &'static str, found: &str) -> Outcome {
    Err(Failure {
        expected,
        found: found.into(),
    })
}

/// What a leaf `separate` says when it does not hold.
pub fn not_apart() -> Outcome {
    fails("min n·p − max n·q > 0", "a value that is not")
}

/// What a leaf `monotone` says when it does not hold.
pub fn not_forward() -> Outcome {
    fails(
        "n·D_k > 0 for every D_k that is not zero, and one such in every piece",
        "a piece or part without",
    )
}

/// Is the leaf one for this pair at all?
pub fn fits(shape: &Shape, a: &Node, b: Option<&Node>, leaf: &Leaf) -> Outcome {
    match (leaf, b) {
        (Leaf::Separate(_), None) => fails("two different nodes", "one"),
        (Leaf::Monotone(_), Some(b)) if !shape.adjacent(a, b) => fails("adjacent nodes", "nodes apart"),
        (Leaf::Separate(_) | Leaf::Monotone(_), _) => Ok(()),
        _ => fails("a rule of the claim motion", leaf.rule()),
    }
}

/// Does a leaf's obligation hold for the pair (A, B), or (A, A) when `b` is `None`, at these positions? Everything is computed anew.
pub fn obligation(shape: &mut Shape, positions: &Positions, a: &Node, b: Option<&Node>, leaf: &Leaf) -> Outcome {
    fits(shape, a, b, leaf)?;
    match (leaf, b) {
        (Leaf::Separate(n), Some(b)) => {
            let [rows_a, rows_b] = [a, b].map(|node| hull_rows(shape, node));
            let [points_a, points_b] = [(a, &rows_a), (b, &rows_b)].map(|(node, rows)| match rows {
                Some(rows) => Points::Part(rows),
                None => {
                    let (first, last) = (*shape.places(node).start(), *shape.places(node).end());
                    match node {
                        Node::Run { .. } => Points::Span(first, last),
                        Node::Part { .. } => Points::Direct(first, last),
                    }
                }
            });
            match separated(points_a, points_b, positions, n) {
                true => Ok(()),
                false => not_apart(),
            }
        }
        (Leaf::Monotone(n), b) => {
            for node in std::iter::once(a).chain(b) {
                for piece in node.pieces() {
                    let part = match node {
                        Node::Run { .. } => Node::of_pieces(piece, piece + 1),
                        Node::Part { .. } => *node,
                    };
                    let rows = hull_rows(shape, &part);
                    let points = match &rows {
                        Some(rows) => Points::Part(rows),
                        None => Points::Direct(shape.pieces[piece].first, shape.pieces[piece].last),
                    };
                    if !goes(points, positions, n) {
                        return not_forward();
                    }
                }
            }
            Ok(())
        }
        _ => Ok(()),
    }
}

/// The rows of a part, unless it is a whole piece with its control points as they are.
fn hull_rows(shape: &mut Shape, node: &Node) -> Option<PartRows> {
    match *node {
        Node::Part { piece, depth: 0, .. } if shape.pieces[piece].direct => None,
        Node::Part { piece, depth, index } => Some(shape.part_rows(piece, depth, index)),
        Node::Run { .. } => None,
    }
}
