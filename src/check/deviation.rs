//! The claim `deviation`: the greatest distance between a curve and its control polygon after subdivision (FORMAT §13, proofs in docs/deviation.md).
//!
//! On a segment of the polygon let L be linear between two control points. With c = X/w, |c − L|² ≤ U when and only when U·w² − |X − w·L|² ≥ 0, a polynomial.

use super::chain::Chain;
use super::polynomial::{Bound, NotShown, convolution, halves, scaled, show, unscaled};
use super::rule::Failure;
use super::{Place, Reason, Rejection};
use crate::claim::deviation::{Content, Evidence, Statement};
use crate::curve::Curve;
use crate::number::{Integer, Rational, RationalExt};

/// Pieces are halved so often at most.
pub const MOST_SUBDIVISIONS: u32 = 16;
/// The polygon has so many edges at most.
pub const MOST_EDGES: u64 = 1 << 22;

/// A part of a piece: the Bernstein coefficients of X (d columns) and w, all over one positive number.
#[derive(Clone, Debug)]
pub struct Part {
    pub(super) columns: Vec<Vec<Integer>>,
}

/// Edges of the control polygon after subdivision, if there are not too many.
pub fn edges(chain: &Chain, subdivisions: u32) -> Option<u64> {
    if subdivisions > MOST_SUBDIVISIONS {
        return None;
    }
    let before: u64 = chain.pieces.iter().map(|piece| piece.degree as u64).sum();
    Some(before << subdivisions).filter(|edges| *edges <= MOST_EDGES)
}

/// The parts of a piece in order.
pub fn parts(chain: &Chain, piece: usize, subdivisions: u32) -> Vec<Part> {
    let numbers = chain
        .numbers_as::<Integer>(piece)
        .expect("integers of any size hold all numbers");
    let mut columns: Vec<Vec<Integer>> = (0..chain.dimension)
        .map(|axis| numbers.points.iter().map(|point| point[axis].clone()).collect())
        .collect();
    columns.push(if numbers.weights.is_empty() {
        vec![chain.pieces[piece].point_scale.value(); numbers.points.len()]
    } else {
        numbers.weights
    });
    let mut parts = vec![Part { columns }];
    for _ in 0..subdivisions {
        parts = parts.iter().flat_map(Part::halves).collect();
    }
    parts
}

impl Part {
    /// The parts on [0, 1/2] and [1/2, 1].
    pub(super) fn halves(&self) -> [Part; 2] {
        let (left, right) = self.columns.iter().map(|column| halves(column)).unzip();
        [Part { columns: left }, Part { columns: right }].map(Part::reduced)
    }

    /// Without common factors of two.
    fn reduced(mut self) -> Part {
        let zeros = self
            .columns
            .iter()
            .flatten()
            .filter_map(Integer::trailing_zeros)
            .min()
            .unwrap_or(0);
        for x in self.columns.iter_mut().flatten() {
            *x = &*x >> zeros as u32;
        }
        self
    }

    /// Edges of the part's control polygon.
    pub fn degree(&self) -> usize {
        self.columns[0].len() - 1
    }

    /// Control point k: X and w.
    fn control(&self, k: usize) -> (Vec<Integer>, Integer) {
        let d = self.columns.len() - 1;
        let point = (0..d).map(|axis| self.columns[axis][k].clone()).collect();
        (point, self.columns[d][k].clone())
    }

    /// Control point k.
    pub fn control_point(&self, k: usize) -> Vec<Rational> {
        let (point, weight) = self.control(k);
        point.into_iter().map(|x| Rational::new(x, weight.clone())).collect()
    }

    /// The weights, over the first.
    pub fn weights(&self) -> Vec<Rational> {
        let weights = &self.columns[self.columns.len() - 1];
        let over = |w: &Integer| Rational::new(w.clone(), weights[0].clone());
        weights.iter().map(over).collect()
    }

    /// |c(u) − L(u)|² at a parameter of the part.
    pub fn squared_at(&self, u: &Rational) -> Rational {
        let n = self.degree();
        let scaled = u * Rational::from_integer(n.into());
        let edge = scaled
            .floor()
            .to_integer()
            .to_u64()
            .map_or(n - 1, |edge| (edge as usize).min(n - 1));
        let v = scaled - Rational::from_integer(edge.into());
        let value = |column: &[Integer]| {
            let mut row: Vec<Rational> = column.iter().cloned().map(Rational::from_integer).collect();
            for round in (1..row.len()).rev() {
                for k in 0..round {
                    row[k] = &row[k] + (&row[k + 1] - &row[k]) * u;
                }
            }
            row.swap_remove(0)
        };
        let d = self.columns.len() - 1;
        let weight = value(&self.columns[d]);
        let (p, q) = (self.control_point(edge), self.control_point(edge + 1));
        (0..d).fold(Rational::from_integer(Integer::ZERO), |sum, axis| {
            let on_polygon = &p[axis] + (&q[axis] - &p[axis]) * &v;
            let difference = value(&self.columns[axis]) / &weight - on_polygon;
            sum + &difference * &difference
        })
    }

    /// Shows by halving that |c − L|² ≤ `upper_squared` on an edge.
    ///
    /// # Errors
    /// Where, from 0 to 1 on the edge, it is greater; or that halving does not come to an end.
    pub fn show(&self, edge: usize, upper_squared: &Rational) -> Result<(), NotShown> {
        let n = self.degree();
        let columns: Vec<Vec<Integer>> = self
            .columns
            .iter()
            .map(|column| {
                let end = cut(column, edge, n);
                // What is left runs from edge/n to 1; the edge ends at 1/(n − edge) of it.
                let reversed: Vec<Integer> = end.into_iter().rev().collect();
                cut(&reversed, n - edge - 1, n - edge).into_iter().rev().collect()
            })
            .collect();
        let d = columns.len() - 1;
        let ((p, a), (q, b)) = (self.control(edge), self.control(edge + 1));
        let weight = scaled(&columns[d]);
        let one = [Integer::ONE, Integer::ONE];
        let both = &a * &b;
        let mut difference: Vec<Integer> = {
            let squares = convolution(&convolution(&weight, &weight), &convolution(&one, &one));
            let factor = upper_squared.numer() * &both * &both;
            squares.iter().map(|x| x * &factor).collect()
        };
        for axis in 0..d {
            let moved = convolution(&scaled(&columns[axis]), &one);
            let line = convolution(&weight, &[&p[axis] * &b, &q[axis] * &a]);
            let f: Vec<Integer> = moved.iter().zip(line).map(|(x, y)| x * &both - y).collect();
            for (total, square) in difference.iter_mut().zip(convolution(&f, &f)) {
                *total -= square * upper_squared.denom();
            }
        }
        show(unscaled(difference).0, Bound::NonNegative)
    }
}

/// The coefficients on [p/q, 1], times q to the power of the degree (de Casteljau).
fn cut(coefficients: &[Integer], p: usize, q: usize) -> Vec<Integer> {
    let (p, rest, q) = (Integer::from(p), Integer::from(q - p), Integer::from(q));
    let degree = coefficients.len() - 1;
    let mut row = coefficients.to_vec();
    for round in 0..degree {
        for k in 0..degree - round {
            row[k] = &row[k] * &rest + &row[k + 1] * &p;
        }
        for x in &mut row[degree - round..] {
            *x = &*x * &q;
        }
    }
    row
}

/// Checks statement and evidence about a curve.
///
/// # Errors
/// The obligation that does not hold.
pub fn check_deviation(curve: &Curve, content: &Content) -> Result<(), Rejection> {
    let Statement {
        subdivisions,
        lower_squared,
        upper_squared,
    } = &content.statement;
    if lower_squared > upper_squared {
        return Err(Rejection {
            place: Place::Statement,
            reason: Reason::Reversed,
        });
    }
    let chain = Chain::new(curve).map_err(|piece| Rejection {
        place: Place::Curve,
        reason: Reason::PointPiece { piece },
    })?;
    obligations(&chain, &content.evidence, *subdivisions, [lower_squared, upper_squared]).map_err(|failure| Rejection {
        place: Place::Evidence,
        reason: Reason::Obligation {
            rule: "deviation",
            failure,
        },
    })
}

fn obligations(
    chain: &Chain,
    Evidence { piece, part, u }: &Evidence,
    subdivisions: u32,
    [lower_squared, upper_squared]: [&Rational; 2],
) -> Result<(), Failure> {
    let fails = |expected, found: String| Err(Failure { expected, found });
    if edges(chain, subdivisions).is_none() {
        return fails(
            "at most 16 subdivisions and 4,194,304 edges",
            format!("{subdivisions} subdivisions"),
        );
    }
    if *piece >= chain.pieces.len() {
        return fails("a piece of the curve", format!("piece {piece}"));
    }
    if *part >> subdivisions != 0 {
        return fails("a part of the piece", format!("part {part}"));
    }
    if u.numer().is_negative() || *u > Rational::from_integer(Integer::ONE) {
        return fails("a local parameter from 0 to 1", u.format());
    }
    for number in 0..chain.pieces.len() {
        for (j, here) in parts(chain, number, subdivisions).iter().enumerate() {
            if number == *piece && j as u64 == *part && here.squared_at(u) < *lower_squared {
                return fails("a squared distance of at least lower_squared", "a smaller one".into());
            }
            for edge in 0..here.degree() {
                if here.show(edge, upper_squared).is_err() {
                    let found =
                        format!("a greater one on edge {edge} of part {j} of piece {number}, or no end of halving");
                    return fails("a squared distance of at most upper_squared by halving", found);
                }
            }
        }
    }
    Ok(())
}
