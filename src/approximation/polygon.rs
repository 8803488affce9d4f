//! The control polygon of a uniformly subdivided curve, in integers over one denominator.

use super::ApproximationError;
use super::difference::{nairn_peters_lutterkort, whole};
use super::segment::{Point, dot, subtract};
use crate::curve::{Chain, Joint};
use crate::number::{Integer, Rational};

/// The greatest number of subdivisions.
pub const MOST_SUBDIVISIONS: u32 = 16;
/// The greatest number of edges.
pub const MOST_EDGES: u64 = 1 << 18;

/// The control polygon of a polynomial curve after m uniform subdivisions: every piece makes 2^m parts of its degree.
#[derive(Clone, Debug)]
pub struct Polygon {
    dimension: usize,
    pub(super) subdivisions: u32,
    pub(super) closed: bool,
    pub(super) denominator: Integer,
    pub(super) parts: Vec<Part>,
    pub(super) edges: usize,
    /// Whether the joint at the start of each part is smooth; the first for the closing point.
    pub(super) smooth: Vec<bool>,
}

/// One part.
#[derive(Clone, Debug)]
pub(super) struct Part {
    /// Control points times the denominator.
    pub points: Vec<Point>,
    /// n·(p_{k+1} − p_k) times the denominator: 2^-m times the hodograph in the parameter of the piece.
    pub derivative: Vec<Point>,
    /// How many edges the parts before have.
    pub first_edge: usize,
}

impl Part {
    fn new(points: Vec<Point>, first_edge: usize) -> Part {
        let n = Integer::from(points.len() - 1);
        let derivative = points
            .windows(2)
            .map(|pair| subtract(&pair[1], &pair[0]).map(|x| x * &n))
            .collect();
        Part {
            points,
            derivative,
            first_edge,
        }
    }

    pub fn degree(&self) -> usize {
        self.points.len() - 1
    }
}

impl Polygon {
    /// Subdivides every piece of a chain `subdivisions` times at its midpoint.
    ///
    /// # Errors
    /// [`ApproximationError::RationalPiece`] and [`ApproximationError::TooMany`].
    pub fn new(chain: &Chain, subdivisions: u32) -> Result<Polygon, ApproximationError> {
        let pieces = chain.pieces();
        if let Some(piece) = pieces.iter().position(|piece| !piece.is_polynomial()) {
            return Err(ApproximationError::RationalPiece { piece });
        }
        let edges = pieces.iter().fold(0, |sum, piece| sum + piece.degree() as u64);
        if subdivisions > MOST_SUBDIVISIONS || edges > MOST_EDGES >> subdivisions {
            return Err(ApproximationError::TooMany);
        }
        let degree = pieces.iter().map(|piece| piece.degree()).max().unwrap_or(1) as u32;
        let common = pieces
            .iter()
            .fold(Integer::ONE, |common, piece| common.lcm(piece.points().denominator()));
        let mut polygon = Polygon {
            dimension: chain.dimension(),
            subdivisions,
            closed: chain.closed(),
            denominator: &common << (degree * subdivisions),
            parts: Vec::new(),
            edges: 0,
            smooth: Vec::new(),
        };
        for (i, piece) in pieces.iter().enumerate() {
            // Each subdivision multiplies by 2^n; the rest of the common power of two goes first.
            let factor = (&common / piece.points().denominator()) << ((degree - piece.degree() as u32) * subdivisions);
            let numerators = piece.points().numerators();
            let points: Vec<Point> = numerators
                .chunks_exact(chain.dimension())
                .map(|x| std::array::from_fn(|axis| x.get(axis).map_or(Integer::ZERO, |x| x * &factor)))
                .collect();
            let mut rows = vec![points];
            for _ in 0..subdivisions {
                rows = rows.into_iter().flat_map(halve).collect();
            }
            for (k, points) in rows.into_iter().enumerate() {
                polygon.smooth.push(k > 0 || chain.joint(i) == Some(Joint::Smooth));
                let first_edge = polygon.edges;
                polygon.edges += points.len() - 1;
                polygon.parts.push(Part::new(points, first_edge));
            }
        }
        Ok(polygon)
    }

    /// How often every piece was halved, m.
    pub fn subdivisions(&self) -> u32 {
        self.subdivisions
    }

    /// How many edges there are.
    pub fn edges(&self) -> usize {
        self.edges
    }

    /// How many parts there are: 2^m for each piece.
    pub fn parts(&self) -> usize {
        self.parts.len()
    }

    /// Control point `k` of a part.
    ///
    /// # Panics
    /// When there is no such part or point.
    pub fn point(&self, part: usize, k: usize) -> Vec<Rational> {
        self.rational(&self.parts[part].points[k])
    }

    /// The degree of a part.
    ///
    /// # Panics
    /// When there is no such part.
    pub fn degree(&self, part: usize) -> usize {
        self.parts[part].degree()
    }

    /// The polygon at the local parameter 0 ≤ u ≤ 1 of a part: control point k at k/n, linear in between. `None` outside.
    pub fn at(&self, part: usize, u: &Rational) -> Option<Vec<Rational>> {
        let points = &self.parts.get(part)?.points;
        Some(self.rational_vector(&linear(points, u)?, &Integer::ONE))
    }

    /// The curve at the local parameter 0 ≤ u ≤ 1 of a part. `None` outside.
    pub fn curve_at(&self, part: usize, u: &Rational) -> Option<Vec<Rational>> {
        inside(u)?;
        let part = self.parts.get(part)?;
        Some(self.rational_vector(&casteljau(&part.points, u), &Integer::ONE))
    }

    /// The discrete derivative D_m at the local parameter 0 ≤ u ≤ 1 of a part, with respect to the parameter of its piece: the control polygon of the
    /// hodograph, point k at k/(n−1), linear in between; constant for degree 1. `None` outside.
    ///
    /// CPJ12 §3.2 leave out the factor 2^m, without which D_m does not tend to c'.
    pub fn discrete_derivative(&self, part: usize, u: &Rational) -> Option<Vec<Rational>> {
        let derivative = &self.parts.get(part)?.derivative;
        Some(self.rational_vector(&linear(derivative, u)?, &(Integer::ONE << self.subdivisions)))
    }

    /// The derivative of the curve there, with respect to the parameter of its piece. `None` outside.
    pub fn derivative_at(&self, part: usize, u: &Rational) -> Option<Vec<Rational>> {
        inside(u)?;
        let part = self.parts.get(part)?;
        Some(self.rational_vector(&casteljau(&part.derivative, u), &(Integer::ONE << self.subdivisions)))
    }

    /// η² with η = max N∞(n)·‖Δ₂‖ over the parts, lengths Euclidean: |c(u) − L(u)| ≤ η at all parameters.
    pub fn distance_bound_squared(&self) -> Rational {
        let square = &self.denominator * &self.denominator;
        let bound = |part: &Part| {
            let factor = nairn_peters_lutterkort(part.degree());
            let second = part.points.windows(3).map(|p| {
                let second = subtract(&subtract(&p[2], &p[1]), &subtract(&p[1], &p[0]));
                dot(&second, &second)
            });
            Rational::from_integer(second.max().unwrap_or(Integer::ZERO)) * &factor * factor
        };
        self.parts.iter().map(bound).max().unwrap_or_default() / Rational::from_integer(square)
    }

    /// The square of the longest edge.
    pub fn longest_edge_squared(&self) -> Rational {
        let lengths = self.parts.iter().flat_map(|part| {
            part.points.windows(2).map(|pair| {
                let edge = subtract(&pair[1], &pair[0]);
                dot(&edge, &edge)
            })
        });
        let longest = lengths.max().unwrap_or(Integer::ZERO);
        Rational::new(longest, &self.denominator * &self.denominator)
    }

    /// The global parameter of the chain at the local parameter of a part.
    pub(super) fn global(&self, part: usize, u: &Rational) -> Rational {
        (whole(part) + u) / Rational::from_integer(Integer::ONE << self.subdivisions)
    }

    fn rational(&self, point: &Point) -> Vec<Rational> {
        let coordinates = point[..self.dimension].iter();
        coordinates
            .map(|x| Rational::new(x.clone(), self.denominator.clone()))
            .collect()
    }

    fn rational_vector(&self, vector: &[Rational; 3], factor: &Integer) -> Vec<Rational> {
        let scale = Rational::new(factor.clone(), self.denominator.clone());
        vector[..self.dimension].iter().map(|x| x * &scale).collect()
    }
}

fn inside(u: &Rational) -> Option<()> {
    (!u.numer().is_negative() && u.numer() <= u.denom()).then_some(())
}

/// Both halves of a part, times 2^n.
fn halve(mut row: Vec<Point>) -> [Vec<Point>; 2] {
    let n = row.len() - 1;
    let mut left = Vec::with_capacity(n + 1);
    let mut right = Vec::with_capacity(n + 1);
    for round in 0..=n {
        let rest = (n - round) as u32;
        left.push(row[0].clone().map(|x| x << rest));
        right.push(row[n - round].clone().map(|x| x << rest));
        for k in 0..n - round {
            row[k] = std::array::from_fn(|i| &row[k][i] + &row[k + 1][i]);
        }
    }
    right.reverse();
    [left, right]
}

/// The piecewise linear function with the values `points` at equal distances on [0, 1], constant if there is one.
pub(super) fn linear(points: &[Point], u: &Rational) -> Option<[Rational; 3]> {
    inside(u)?;
    let last = points.len() - 1;
    let scaled = u * whole(last);
    let k = (scaled.numer().div_floor(scaled.denom()).to_u64()? as usize).min(last.saturating_sub(1));
    let rest = scaled - whole(k);
    let (start, end) = (&points[k], &points[(k + 1).min(last)]);
    Some(std::array::from_fn(|i| {
        Rational::from_integer(start[i].clone()) + &rest * Rational::from_integer(&end[i] - &start[i])
    }))
}

/// The Bézier curve of control points at 0 ≤ u ≤ 1.
pub(super) fn casteljau(points: &[Point], u: &Rational) -> [Rational; 3] {
    // Integers over q^n for u = p/q.
    let (p, rest) = (u.numer(), u.denom() - u.numer());
    let mut row = points.to_vec();
    for round in (1..row.len()).rev() {
        for k in 0..round {
            row[k] = std::array::from_fn(|i| &row[k][i] * &rest + &row[k + 1][i] * p);
        }
    }
    let denominator = u.denom().pow(points.len() as u32 - 1);
    row[0].clone().map(|x| Rational::new(x, denominator.clone()))
}
