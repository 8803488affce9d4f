//! The control polygon of the cells, which is isotopic to the curve as the inscribed polygon is (docs/embedding.md, Theorem 4).
//!
//! Polynomial pieces need no more than their tree. Of a rational piece the rule `monotone` says how the D_k lie, not how the edges P_{k+1} − P_k do;
//! they are asked for here. De Casteljau's algorithm keeps a polygon that increases along n so, for positive weights.

use std::cmp::Ordering;
use std::collections::HashSet;

use crate::check::chain::Chain;
use crate::check::cover::Context;
use crate::check::element::{Node, Parameter};
use crate::check::hull::Hull;
use crate::check::part::Part;
use crate::check::word::{Word, dot, vector, widening};
use crate::claim::tree::Leaf;
use crate::number::Integer;

/// Whether the leaves seen admit the control polygon of the cells.
pub struct Control {
    admitted: bool,
    rational: bool,
}

impl Control {
    /// No leaf is seen.
    pub fn new(chain: &Chain) -> Self {
        Control {
            admitted: true,
            rational: chain.pieces.iter().any(|piece| piece.rational),
        }
    }

    /// Looks at a leaf whose obligation holds.
    pub fn include(&mut self, context: &Context, a: &Node, b: Option<&Node>, leaf: &Leaf) {
        let Leaf::Monotone(n) = leaf else { return };
        if self.admitted && self.rational {
            self.admitted = std::iter::once(a).chain(b).all(|node| increases_on(context, node, n));
        }
    }

    /// The edges of the control polygon of the cells, those of length 0 not counted; `None` when it is not admitted.
    pub fn edges(&self, chain: &Chain, ends: &HashSet<Parameter>) -> Option<u64> {
        if !self.admitted {
            return None;
        }
        let mut ends: Vec<&Parameter> = ends.iter().collect();
        ends.sort_by(|s, t| compare(s, t));
        let mut edges = 0;
        for cell in ends.windows(2) {
            let (start, end) = (cell[0], cell[1]);
            let last = end.piece + usize::from(end.numerator > 0);
            for piece in start.piece..last {
                let from_start = piece > start.piece || start.numerator == 0;
                let to_end = piece < end.piece;
                edges += edges_of(chain, piece, from_start, to_end);
            }
        }
        Some(edges)
    }
}

/// The order of parameters.
fn compare(s: &Parameter, t: &Parameter) -> Ordering {
    // Numerators are below 2^depth, and depths at most that of the deepest part.
    let depth = s.depth.max(t.depth);
    let of = |x: &Parameter| (x.piece, x.numerator << (depth - x.depth));
    of(s).cmp(&of(t))
}

/// Does the control polygon of a node increase along n, edges of length 0 apart?
fn increases_on(context: &Context, node: &Node, n: &[Integer; 3]) -> bool {
    match node {
        Node::Part(_) => increases(context, node, n),
        Node::Run { first, last, .. } => (*first..*last).all(|piece| {
            let whole = Node::Part(Part::whole(context.chain, piece));
            increases(context, &whole, n)
        }),
        Node::Point(_) => false,
    }
}

fn increases(context: &Context, node: &Node, n: &[Integer; 3]) -> bool {
    widening!(0, W => increases_in::<W>(context, node, n))
}

fn increases_in<W: Word>(context: &Context, node: &Node, n: &[Integer; 3]) -> Option<bool> {
    let n = vector::<W>(n)?;
    let hull = Hull::<W>::new(context, node)?;
    let points: Vec<(&[W; 3], Option<&W>)> = hull.points().collect();
    for pair in points.windows(2) {
        let (p, q) = (at_common_weight(pair[0], pair[1])?, at_common_weight(pair[1], pair[0])?);
        if p != q && dot(&p, &n)? >= dot(&q, &n)? {
            return Some(false);
        }
    }
    Some(true)
}

/// A homogeneous point times the weight of another.
fn at_common_weight<W: Word>(point: (&[W; 3], Option<&W>), other: (&[W; 3], Option<&W>)) -> Option<[W; 3]> {
    let [x, y, z] = point.0;
    Some(match other.1 {
        None => [x.clone(), y.clone(), z.clone()],
        Some(w) => [x.times(w)?, y.times(w)?, z.times(w)?],
    })
}

/// The edges of positive length of the control polygon of a piece, or of a section that begins at its start or reaches its end. Edges of a section are
/// sums with positive coefficients of those of the piece, on one side of a plane: the k-th of a section from the start, of the edges 0 … k.
fn edges_of(chain: &Chain, piece: usize, from_start: bool, to_end: bool) -> u64 {
    let degree = chain.pieces[piece].degree;
    if !from_start && !to_end {
        return degree as u64;
    }
    let zero = widening!(0, W => zero_edges::<W>(chain, piece));
    let leading = zero.iter().take_while(|zero| **zero).count();
    let trailing = zero.iter().rev().take_while(|zero| **zero).count();
    let none = match (from_start, to_end) {
        (true, true) => zero.iter().filter(|zero| **zero).count(),
        (true, false) => leading,
        _ => trailing,
    };
    (degree - none) as u64
}

/// Which edges of a piece's control polygon have length 0.
fn zero_edges<W: Word>(chain: &Chain, piece: usize) -> Option<Vec<bool>> {
    let numbers = chain.numbers_as::<W>(piece)?;
    let weight = |k: usize| numbers.weights.get(k);
    let edges = 0..numbers.points.len() - 1;
    edges
        .map(|k| {
            let (p, q) = ((&numbers.points[k], weight(k)), (&numbers.points[k + 1], weight(k + 1)));
            Some(at_common_weight(p, q)? == at_common_weight(q, p)?)
        })
        .collect()
}
