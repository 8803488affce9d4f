//! A cover tree whose leaves hold at one or two times, and so at all times between.

use super::geometry::{Geometry, Placed};
use crate::check::motion::Node;
use crate::claim::tree::{Leaf, Token};
use crate::prove::vector::{Vector, add, dot, from_integers, inner_direction, quantised, scale, sub, unit};

/// Why no tree was found.
#[derive(Clone, Copy, Debug)]
pub enum Stuck {
    /// A pair that nothing excludes: piece and local parameter in each node, the same twice for one node.
    Pair {
        /// In the first node.
        s: (usize, f64),
        /// In the second node.
        t: (usize, f64),
        /// Do the two nodes meet, or are they one?
        adjacent: bool,
    },
    /// More leaves than allowed.
    Budget,
}

/// A search of one tree.
pub struct Search<'s, 'g, 'c> {
    /// The curve at the times that count.
    pub geometry: &'s mut Geometry<'g, 'c>,
    /// How often a piece is halved at most.
    pub max_depth: u32,
    /// How many more leaves are allowed.
    pub budget: u64,
    /// The tokens found.
    pub tokens: Vec<Token>,
}

/// Steps of Gilbert's algorithm.
const STEPS: usize = 60;

/// Bits of the vectors that are tried.
const BITS: [u32; 3] = [8, 14, 24];

impl Search<'_, '_, '_> {
    /// Covers the pair (A, B), or (A, A) when `b` is `None`.
    pub fn cover(&mut self, a: Node, b: Option<Node>) -> Result<(), Stuck> {
        if let Some(leaf) = self.leaf(&a, b.as_ref()) {
            if self.budget == 0 {
                return Err(Stuck::Budget);
            }
            self.budget -= 1;
            self.tokens.push(Token::Leaf(leaf));
            return Ok(());
        }
        let Some(b) = b else {
            let Some((left, right)) = self.halves(&a) else {
                return Err(self.stuck(&a, None));
            };
            self.tokens.push(Token::Split);
            self.cover(left, None)?;
            self.cover(left, Some(right))?;
            return self.cover(right, None);
        };
        let (of_a, of_b) = (self.halves(&a), self.halves(&b));
        let first = of_b.is_none() || of_a.is_some() && self.size(&a) >= self.size(&b);
        match (of_a, of_b) {
            (Some((left, right)), _) if first => {
                self.tokens.push(Token::First);
                self.cover(left, Some(b))?;
                self.cover(right, Some(b))
            }
            (_, Some((left, right))) => {
                self.tokens.push(Token::Second);
                self.cover(a, Some(left))?;
                self.cover(a, Some(right))
            }
            _ => Err(self.stuck(&a, Some(&b))),
        }
    }

    fn halves(&self, node: &Node) -> Option<(Node, Node)> {
        match node {
            Node::Part { depth, .. } if *depth >= self.max_depth => None,
            node => node.halves(),
        }
    }

    fn size(&mut self, node: &Node) -> f64 {
        let placed = self.geometry.node(node);
        placed
            .iter()
            .fold(0.0, |most, placed| most.max(placed.diagonal_squared))
    }

    fn stuck(&self, a: &Node, b: Option<&Node>) -> Stuck {
        let middle = |node: &Node| match *node {
            Node::Run { first, last } => ((first + last) / 2, 0.0),
            Node::Part { piece, depth, index } => (piece, (index as f64 + 0.5) / 2f64.powi(depth as i32)),
        };
        Stuck::Pair {
            s: middle(a),
            t: middle(b.unwrap_or(a)),
            adjacent: b.is_none_or(|b| self.geometry.shape.adjacent(a, b)),
        }
    }

    fn leaf(&mut self, a: &Node, b: Option<&Node>) -> Option<Leaf> {
        let of_a = self.geometry.node(a);
        match b {
            Some(b) if !self.geometry.shape.adjacent(a, b) => {
                let of_b = self.geometry.node(b);
                separating(&of_a, &of_b).map(|n| Leaf::Separate(n.map(Into::into)))
            }
            b => {
                let of_b = b.map(|b| self.geometry.node(b));
                let of_b = of_b.as_ref().map_or(&[][..], |placed| placed.as_slice());
                increasing(&of_a, of_b).map(|n| Leaf::Monotone(n.map(Into::into)))
            }
        }
    }
}

/// A vector with which all tangents have positive products, for certain.
fn increasing(a: &[Placed], b: &[Placed]) -> Option<[i64; 3]> {
    let all = || a.iter().chain(b);
    if all().any(|placed| placed.idle) {
        return None;
    }
    let tangents: Vec<Vector> = all().flat_map(|placed| &placed.tangents).copied().collect();
    let units: Vec<Vector> = tangents.iter().filter_map(unit).collect();
    // Long and short tangents together: the shortest vector of the hull first, which leaves the most room, then directions alone.
    for vectors in [&tangents, &units] {
        let x = inner_direction(vectors);
        if vectors.iter().any(|v| dot(v, &x) <= 0.0 && dot(v, v) > 0.0) {
            continue;
        }
        for bits in BITS {
            let n = quantised(&x, bits);
            let as_float = from_integers(&n);
            let length = dot(&as_float, &as_float).sqrt();
            let holds = all().all(|placed| {
                let room = length * placed.error;
                let each = |v: &Vector| dot(v, v) == 0.0 || dot(v, &as_float) > room;
                placed.tangents.iter().all(each)
            });
            if holds {
                return Some(n);
            }
        }
    }
    None
}

/// A vector that separates two hulls at all times, for certain, by Gilbert's algorithm.
fn separating(a: &[Placed], b: &[Placed]) -> Option<[i64; 3]> {
    let least = |x: &Vector| {
        let differences = a
            .iter()
            .zip(b)
            .map(|(a, b)| sub(&extreme(&a.hull, x, -1.0), &extreme(&b.hull, x, 1.0)));
        let by_product = |v: &Vector, w: &Vector| dot(v, x).total_cmp(&dot(w, x));
        differences.min_by(by_product)
    };
    let centre = |hull: &[Vector]| {
        scale(
            &hull.iter().fold([0.0; 4], |sum, p| add(&sum, p)),
            1.0 / hull.len() as f64,
        )
    };
    let pairs = a.iter().zip(b);
    let mut x = pairs.fold([0.0; 4], |sum, (a, b)| {
        add(&sum, &sub(&centre(&a.hull), &centre(&b.hull)))
    });
    x = scale(&x, 1.0 / a.len().max(1) as f64);
    let mut best = (0.0, None);
    for _ in 0..STEPS {
        let support = least(&x)?;
        let length = dot(&x, &x).sqrt();
        let reached = dot(&support, &x) / length;
        if reached > best.0 {
            best = (reached, Some(x));
        }
        let step = sub(&x, &support);
        let square = dot(&step, &step);
        if square.is_nan() || square <= 0.0 || reached > 0.98 * length {
            break;
        }
        let fraction = (dot(&x, &step) / square).clamp(0.0, 1.0);
        if fraction <= 0.0 {
            break;
        }
        x = sub(&x, &scale(&step, fraction));
    }
    let x = best.1?;
    BITS.into_iter().map(|bits| quantised(&x, bits)).find(|n| {
        let as_float = from_integers(n);
        let length = dot(&as_float, &as_float).sqrt();
        a.iter().zip(b).all(|(a, b)| {
            let gap = sub(&extreme(&a.hull, &as_float, -1.0), &extreme(&b.hull, &as_float, 1.0));
            dot(&gap, &as_float) > length * a.error
        })
    })
}

/// The point whose product with x, times the sign, is greatest.
fn extreme(points: &[Vector], x: &Vector, sign: f64) -> Vector {
    let mut best = (f64::NEG_INFINITY, points[0]);
    for point in points {
        let product = sign * dot(point, x);
        if product > best.0 {
            best = (product, *point);
        }
    }
    best.1
}
