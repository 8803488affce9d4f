//! The distance between two curves: a tree over pairs of a node of one and a node of the other.

use std::collections::HashMap;
use std::rc::Rc;

use super::super::deviation::Part;
use super::super::rule::Failure;
use super::pieces::Pieces;
use crate::claim::tree::{Leaf, Token, token_text};
use crate::number::{Integer, Rational};

/// A piece is halved so often at most.
const MOST_HALVINGS: u32 = 120;

/// The corners of a box: lowest and highest coordinates.
type Corners = [Vec<Rational>; 2];

/// A part of a curve.
#[derive(Clone)]
pub enum Node {
    /// At least two consecutive pieces.
    Run {
        /// The first.
        first: usize,
        /// The one behind the last.
        behind: usize,
        /// The smallest box around their control points.
        corners: Rc<Corners>,
    },
    /// A piece or a part of one, so often halved.
    Part {
        /// Its coefficients.
        part: Rc<Part>,
        /// How often the piece was halved.
        halvings: u32,
    },
}

/// The nodes of a curve.
pub struct Nodes<'p> {
    pieces: &'p Pieces,
    boxes: HashMap<[usize; 2], Rc<Corners>>,
}

impl<'p> Nodes<'p> {
    /// Those of these pieces.
    pub fn new(pieces: &'p Pieces) -> Self {
        Nodes {
            pieces,
            boxes: HashMap::new(),
        }
    }

    /// The node of the whole curve.
    pub fn whole(&mut self) -> Node {
        self.run(0, self.pieces.pieces.len())
    }

    fn run(&mut self, first: usize, behind: usize) -> Node {
        if behind - first == 1 {
            let part = Rc::new(self.pieces.pieces[first].clone());
            return Node::Part { part, halvings: 0 };
        }
        let corners = self.corners(first, behind);
        Node::Run { first, behind, corners }
    }

    fn corners(&mut self, first: usize, behind: usize) -> Rc<Corners> {
        if let Some(known) = self.boxes.get(&[first, behind]) {
            return Rc::clone(known);
        }
        let corners = if behind - first == 1 {
            let piece = &self.pieces.pieces[first];
            let points: Vec<Vec<Rational>> = (0..=piece.degree()).map(|k| piece.control_point(k)).collect();
            let range = |axis: usize| points.iter().map(move |point| &point[axis]);
            let of = |end: &dyn Fn(usize) -> Option<Rational>| (0..self.pieces.dimension).filter_map(end).collect();
            [
                of(&|axis| range(axis).min().cloned()),
                of(&|axis| range(axis).max().cloned()),
            ]
        } else {
            let middle = usize::midpoint(first, behind);
            let (a, b) = (self.corners(first, middle), self.corners(middle, behind));
            let of = |end: usize, choose: fn(Rational, Rational) -> Rational| {
                let pairs = a[end].iter().zip(&b[end]);
                pairs.map(|(x, y)| choose(x.clone(), y.clone())).collect()
            };
            [of(0, Ord::min), of(1, Ord::max)]
        };
        let corners = Rc::new(corners);
        self.boxes.insert([first, behind], Rc::clone(&corners));
        corners
    }

    /// The two nodes that a node is made of; nothing of a part halved 120 times.
    pub fn halves(&mut self, node: &Node) -> Option<[Node; 2]> {
        match node {
            Node::Run { first, behind, .. } => {
                let middle = usize::midpoint(*first, *behind);
                Some([self.run(*first, middle), self.run(middle, *behind)])
            }
            Node::Part { halvings, .. } if *halvings == MOST_HALVINGS => None,
            Node::Part { part, halvings } => Some(part.halves().map(|half| Node::Part {
                part: Rc::new(half),
                halvings: halvings + 1,
            })),
        }
    }
}

impl Node {
    /// The least n·p over the node's hull points p, as a fraction with a positive denominator.
    fn least(&self, n: &[Integer]) -> (Integer, Integer) {
        match self {
            Node::Run { corners, .. } => {
                let sum = n
                    .iter()
                    .enumerate()
                    .fold(Rational::from_integer(Integer::ZERO), |sum, (axis, n)| {
                        let end = usize::from(n.is_negative());
                        sum + Rational::from_integer(n.clone()) * &corners[end][axis]
                    });
                (sum.numer().clone(), sum.denom().clone())
            }
            Node::Part { part, .. } => {
                let (weights, axes) = part.columns.split_last().expect("a column of weights");
                let along = |k: usize| {
                    let terms = axes.iter().zip(n).map(|(column, n)| &column[k] * n);
                    terms.fold(Integer::ZERO, |sum, term| sum + term)
                };
                let mut least = (along(0), &weights[0]);
                for (k, weight) in weights.iter().enumerate().skip(1) {
                    let value = along(k);
                    if &value * least.1 < &least.0 * weight {
                        least = (value, weight);
                    }
                }
                (least.0, least.1.clone())
            }
        }
    }
}

/// `far n`: g = min n·p − max n·q over the hull points p of the first node and q of the second is positive, and g² ≥ lower·(n·n).
pub fn is_far(a: &Node, b: &Node, n: &[Integer], lower_squared: &Rational) -> bool {
    let opposite: Vec<Integer> = n.iter().map(|x| -x).collect();
    // max n·q = −min (−n)·q
    let ((x, v), (y, w)) = (a.least(n), b.least(&opposite));
    let gap = &x * &w + &y * &v;
    if !gap.is_positive() {
        return false;
    }
    let square = n.iter().fold(Integer::ZERO, |sum, x| sum + x * x);
    let scale = v * w;
    &gap * &gap * lower_squared.denom() >= &scale * &scale * square * lower_squared.numer()
}

/// Walks the tree of a lower bound.
///
/// # Errors
/// The first token that is none of this tree or whose obligation does not hold, or that there are too few or too many.
pub fn check_tree(curve: &Pieces, other: &Pieces, tokens: &[Token], lower_squared: &Rational) -> Result<(), Failure> {
    let fails = |expected, found| Err(Failure { expected, found });
    let (mut here, mut there) = (Nodes::new(curve), Nodes::new(other));
    let mut stack = vec![(here.whole(), there.whole())];
    for (number, token) in tokens.iter().enumerate() {
        let Some((a, b)) = stack.pop() else {
            return fails("a tree that ends with its tokens", "tokens left over".into());
        };
        match token {
            Token::First | Token::Second => {
                let halves = match token {
                    Token::First => here.halves(&a).map(|[x, y]| [(x, b.clone()), (y, b)]),
                    _ => there.halves(&b).map(|[x, y]| [(a.clone(), x), (a, y)]),
                };
                let Some([x, y]) = halves else {
                    return fails("a part halved at most 120 times", format!("token {number}"));
                };
                stack.push(y);
                stack.push(x);
            }
            Token::Leaf(Leaf::Far(n)) => {
                if !is_far(&a, &b, &n[..curve.dimension], lower_squared) {
                    let text = token_text(token, curve.dimension);
                    return fails("nodes that are far along n", format!("token {number}, {text}"));
                }
            }
            Token::Split | Token::Leaf(_) => {
                let text = token_text(token, curve.dimension);
                return fails("a token first, second or far", format!("token {number}, {text}"));
            }
        }
    }
    match stack.is_empty() {
        true => Ok(()),
        false => fails(
            "a tree that ends with its tokens",
            "no token for a pair of nodes".into(),
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::{Bezier, Curve, Form};
    use crate::number::RationalVector;

    fn fraction(numerator: i64, denominator: i64) -> Rational {
        Rational::new(Integer::from(numerator), Integer::from(denominator))
    }

    fn polygon(points: &[[i64; 2]]) -> Pieces {
        let piece = |pair: &[[i64; 2]]| {
            let numbers: Vec<Rational> = pair.iter().flatten().map(|x| fraction(*x, 1)).collect();
            Bezier::new(2, RationalVector::from_rationals(&numbers), None).expect("a piece")
        };
        let pieces = points.windows(2).map(piece).collect();
        Pieces::new(&Curve::new(2, Form::Bezier(pieces)).expect("a curve")).expect("no points")
    }

    #[test]
    fn boxes_and_hulls() {
        let pieces = polygon(&[[0, 0], [4, 1], [2, 7], [-1, 3]]);
        let mut nodes = Nodes::new(&pieces);
        let whole = nodes.whole();
        let n = [1, -1].map(Integer::from);
        // The box reaches from (−1, 0) to (4, 7).
        assert_eq!(whole.least(&n), (Integer::from(-8), Integer::ONE));
        let [first, rest] = nodes.halves(&whole).expect("halves");
        assert_eq!(first.least(&n), (Integer::ZERO, Integer::ONE));
        // That of the second and third piece from (−1, 1).
        assert_eq!(rest.least(&[0, 1].map(Integer::from)), (Integer::ONE, Integer::ONE));
        let Some([_, half]) = nodes.halves(&first) else {
            panic!("a part has halves");
        };
        let (x, w) = half.least(&[1, 0].map(Integer::from));
        assert_eq!(Rational::new(x, w), fraction(2, 1));
    }

    #[test]
    fn far_to_the_last_digit() {
        let (a, b) = (polygon(&[[0, 0], [1, 0]]), polygon(&[[0, -3], [1, -5]]));
        let (a, b) = (Nodes::new(&a).whole(), Nodes::new(&b).whole());
        let n = |x, y| [Integer::from(x), Integer::from(y)];
        assert!(is_far(&a, &b, &n(0, 2), &fraction(9, 1)));
        assert!(!is_far(&a, &b, &n(0, 2), &fraction(9_000_000_001, 1_000_000_000)));
        assert!(!is_far(&a, &b, &n(0, -2), &fraction(1, 9)));
        assert!(!is_far(&a, &b, &n(0, 0), &fraction(0, 1)));
        assert!(is_far(&b, &a, &n(0, -2), &fraction(9, 1)));
    }

    #[test]
    fn parts_are_halved_a_hundred_and_twenty_times() {
        let pieces = polygon(&[[0, 0], [1, 0]]);
        let mut nodes = Nodes::new(&pieces);
        let mut node = nodes.whole();
        for _ in 0..MOST_HALVINGS {
            [node, _] = nodes.halves(&node).expect("a half");
        }
        assert!(nodes.halves(&node).is_none());
    }
}
