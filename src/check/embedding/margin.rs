//! How far the control points may move before a leaf's obligation fails.
//!
//! Every inequality of a leaf reads f(P) > 0 with f(P) = Σ m_j n·P_j. When each P_j moves by δ_j, f changes by at most
//! Σ|m_j| · max|n·δ_j|, and |n·δ_j| is at most |n|₁ times the greatest coordinate of δ_j, and at most |n| times its length. So the
//! inequality stays true as long as max‖δ_j‖ < f(P)/(Σ|m_j|·‖n‖) with the dual norm of n: |n|₁ or |n|.

use super::rows::{Own, Rows, Table, weight};
use crate::check::chain::Chain;
use crate::check::element::Node;
use crate::claim::tree::Leaf;
use crate::curve::Curve;
use crate::number::{Integer, Rational};

/// The least margins of the leaves seen.
pub struct Margins<'c> {
    table: Table<'c>,
    infinity: Option<Rational>,
    euclidean_squared: Option<Rational>,
}

/// A fraction that is not reduced; the denominator is positive.
struct Fraction {
    numerator: Integer,
    denominator: Integer,
}

impl Fraction {
    fn less(&self, other: &Fraction) -> bool {
        &self.numerator * &other.denominator < &other.numerator * &self.denominator
    }

    fn value(self) -> Rational {
        Rational::new(self.numerator, self.denominator)
    }
}

/// The lesser of two, if there is one already.
fn keep_least(least: &mut Option<Fraction>, found: Fraction) {
    if least.as_ref().is_none_or(|least| found.less(least)) {
        *least = Some(found);
    }
}

fn product(row: &[Integer], products: &[Integer]) -> Integer {
    let terms = row.iter().zip(products).map(|(x, y)| x * y);
    terms.fold(Integer::ZERO, |sum, term| sum + term)
}

/// The sum of the magnitudes of coefficients, those of one control point taken together.
fn size(mut terms: Vec<(usize, Integer)>) -> Integer {
    terms.sort_by_key(|(number, _)| *number);
    let mut sum = Integer::ZERO;
    let mut rest = terms.into_iter().peekable();
    while let Some((number, mut coefficient)) = rest.next() {
        while let Some((_, more)) = rest.next_if(|(other, _)| *other == number) {
            coefficient += more;
        }
        sum += coefficient.abs();
    }
    sum
}

fn terms<'t>(own: &'t Own, row: &'t [Integer], factor: &'t Integer) -> impl Iterator<Item = (usize, Integer)> + 't {
    row.iter().enumerate().map(move |(j, x)| (own.number(j), x * factor))
}

/// The least and the greatest n·p over hull points of a piece or part.
fn extremes(own: &Own, rows: &Rows, n: &[Integer; 3], greatest: bool) -> Option<Fraction> {
    let products = own.products(n);
    let mut best: Option<Fraction> = None;
    for row in &rows.hull {
        let found = Fraction {
            numerator: product(row, &products),
            denominator: weight(row) * own.denominator,
        };
        if best.as_ref().is_none_or(|best| found.less(best) != greatest) {
            best = Some(found);
        }
    }
    best
}

impl<'c> Margins<'c> {
    /// Nothing seen of a curve.
    pub fn new(curve: &'c Curve, chain: &Chain) -> Self {
        Margins {
            table: Table::new(curve, chain),
            infinity: None,
            euclidean_squared: None,
        }
    }

    /// The least margins: in the norm of greatest coordinates, and the square of that in the Euclidean norm.
    pub fn least(self) -> (Rational, Rational) {
        (
            self.infinity.unwrap_or_default(),
            self.euclidean_squared.unwrap_or_default(),
        )
    }

    /// Takes account of a leaf whose obligation holds.
    pub fn include(&mut self, a: &Node, b: Option<&Node>, leaf: &Leaf) {
        let (margin, n) = match (leaf, b) {
            (Leaf::Separate(n), Some(b)) => (self.separate(a, b, n), n),
            (Leaf::Monotone(n), b) => (self.monotone(a, b, n), n),
            // No other leaf has an obligation in this claim that holds.
            _ => return,
        };
        let sum = n.iter().fold(Integer::ZERO, |sum, x| sum + x.abs());
        let square = n.iter().fold(Integer::ZERO, |sum, x| sum + x * x);
        let infinity = &margin / Rational::from_integer(sum);
        let euclidean_squared = &margin * &margin / Rational::from_integer(square);
        let lower = |least: &mut Option<Rational>, found: Rational| {
            if least.as_ref().is_none_or(|least| found < *least) {
                *least = Some(found);
            }
        };
        lower(&mut self.infinity, infinity);
        lower(&mut self.euclidean_squared, euclidean_squared);
    }

    /// The least f(P)/Σ|m_j| of a leaf `separate`.
    fn separate(&mut self, a: &Node, b: &Node, n: &[Integer; 3]) -> Rational {
        if let (Node::Part(first), Node::Part(second)) = (a, b) {
            let (own_a, own_b) = (self.table.own(first.piece), self.table.own(second.piece));
            let share = (0..own_a.count).any(|i| (0..own_b.count).any(|j| own_a.number(i) == own_b.number(j)));
            if share {
                let (rows_a, rows_b) = (self.table.of_part(first), self.table.of_part(second));
                return separate_parts([&own_a, &own_b], [&rows_a, &rows_b], n);
            }
        }
        // Both points are convex combinations of control points: Σ|m_j| is at most 2, and 2 where they share none.
        let (low, high) = (self.extreme(a, n, false), self.extreme(b, n, true));
        (low - high) / Rational::from_integer(2.into())
    }

    /// The least or greatest n·p over the hull points of a part or the control points of a run.
    fn extreme(&mut self, node: &Node, n: &[Integer; 3], greatest: bool) -> Rational {
        let mut best: Option<Fraction> = None;
        for piece in pieces(node) {
            let rows = self.rows(node, piece);
            let found = extremes(&self.table.own(piece), &rows, n, greatest);
            if let Some(found) = found
                && best.as_ref().is_none_or(|best| found.less(best) != greatest)
            {
                best = Some(found);
            }
        }
        best.map(Fraction::value).unwrap_or_default()
    }

    /// The least f(P)/Σ|m_j| of a leaf `monotone`. A coefficient of D that is zero gives 0.
    fn monotone(&mut self, a: &Node, b: Option<&Node>, n: &[Integer; 3]) -> Rational {
        let mut least: Option<Fraction> = None;
        for node in std::iter::once(a).chain(b) {
            for piece in pieces(node) {
                let rows = self.rows(node, piece);
                let own = self.table.own(piece);
                let products = own.products(n);
                for row in &rows.tangents {
                    let size = size(terms(&own, row, &Integer::ONE).collect());
                    if size.is_zero() {
                        return Rational::default();
                    }
                    let found = Fraction {
                        numerator: product(row, &products),
                        denominator: size * own.denominator,
                    };
                    keep_least(&mut least, found);
                }
            }
        }
        least.map(Fraction::value).unwrap_or_default()
    }

    fn rows(&mut self, node: &Node, piece: usize) -> std::rc::Rc<Rows> {
        match node {
            Node::Part(part) => self.table.of_part(part),
            _ => self.table.of_piece(piece),
        }
    }
}

/// The pieces of a node of the convention `smooth`, where element i is piece i.
fn pieces(node: &Node) -> std::ops::Range<usize> {
    match node {
        Node::Run { first, last, .. } => *first..*last,
        Node::Part(part) => part.piece..part.piece + 1,
        Node::Point(_) => 0..0,
    }
}

/// The least (n·p − n·q)/Σ|m_j| over hull points of two parts whose control points are partly the same.
fn separate_parts(own: [&Own; 2], rows: [&Rows; 2], n: &[Integer; 3]) -> Rational {
    let [products_a, products_b] = own.map(|own| own.products(n));
    let mut least: Option<Fraction> = None;
    for p in &rows[0].hull {
        let (of_p, weight_p) = (product(p, &products_a), weight(p));
        for q in &rows[1].hull {
            let (of_q, weight_q) = (product(q, &products_b), weight(q));
            let opposite = -&weight_p;
            let merged = terms(own[0], p, &weight_q).chain(terms(own[1], q, &opposite));
            let size = size(merged.collect());
            if size.is_zero() {
                return Rational::default();
            }
            let found = Fraction {
                numerator: &of_p * &weight_q * own[1].denominator - of_q * &weight_p * own[0].denominator,
                denominator: size * own[0].denominator * own[1].denominator,
            };
            keep_least(&mut least, found);
        }
    }
    least.map(Fraction::value).unwrap_or_default()
}
