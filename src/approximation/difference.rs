//! Second centred differences, edges, and the bounds by them.

use super::ApproximationError;
use crate::curve::{Bezier, Chain};
use crate::number::{Integer, Rational};

/// N∞(n) = ⌊n/2⌋⌈n/2⌉/(2n) (Nairn, Peters, Lutterkort 1999): for a polynomial Bézier curve c of degree n with control polygon L,
/// |c(t) − L(t)| ≤ N∞(n)·max‖Δ²P‖, in any norm. 0 for the degrees 0 and 1, where curve and polygon are the same.
pub fn nairn_peters_lutterkort(degree: usize) -> Rational {
    let (low, high) = (degree / 2, degree.div_ceil(2));
    Rational::new((low * high).into(), (2 * degree).max(1).into())
}

/// A norm of vectors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Norm {
    /// The greatest absolute coordinate, which CPJ12 print.
    Infinity,
    /// The length.
    Euclidean,
}

/// The greatest norm among some vectors, in both norms; 0 where there are none.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Norms {
    /// The greatest absolute coordinate.
    pub infinity: Rational,
    /// The square of the greatest length.
    pub euclidean_squared: Rational,
}

impl Norms {
    /// Those of some vectors.
    fn of(vectors: impl IntoIterator<Item = Vec<Rational>>) -> Norms {
        let mut norms = Norms::default();
        for vector in vectors {
            norms.euclidean_squared = norms.euclidean_squared.max(squared_length(&vector));
            for x in vector {
                norms.infinity = norms.infinity.max(absolute(x));
            }
        }
        norms
    }

    /// The square of the one asked for.
    pub fn squared(&self, norm: Norm) -> Rational {
        match norm {
            Norm::Infinity => &self.infinity * &self.infinity,
            Norm::Euclidean => self.euclidean_squared.clone(),
        }
    }
}

/// What CPJ12's formulas take from one polynomial piece.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PieceMeasures {
    /// The degree n.
    pub degree: usize,
    /// max ‖Δ₂p_i‖ over the inner control points, Δ₂p_i = p_{i−1} − 2p_i + p_{i+1}.
    pub second: Norms,
    /// max ‖Δ₂(Δp_i)‖ for the hodograph's control points Δp_i = n(p_{i+1} − p_i).
    pub derivative_second: Norms,
    /// The square of the longest edge of its control polygon.
    pub longest_edge_squared: Rational,
    /// The square of the shortest edge of its control polygon.
    pub shortest_edge_squared: Rational,
}

/// Measures every piece of a chain.
///
/// # Errors
/// [`ApproximationError::RationalPiece`].
pub fn measure(chain: &Chain) -> Result<Vec<PieceMeasures>, ApproximationError> {
    let pieces = chain.pieces().iter().enumerate();
    pieces.map(|(i, piece)| measure_piece(i, piece)).collect()
}

fn measure_piece(piece: usize, bezier: &Bezier) -> Result<PieceMeasures, ApproximationError> {
    if !bezier.is_polynomial() {
        return Err(ApproximationError::RationalPiece { piece });
    }
    let n = bezier.degree();
    let points: Vec<Vec<Rational>> = (0..=n).map(|k| bezier.point(k)).collect();
    let edges = differences(&points);
    let lengths: Vec<Rational> = edges.iter().map(|edge| squared_length(edge)).collect();
    let scaled: Vec<Vec<Rational>> = edges
        .iter()
        .map(|edge| edge.iter().map(|x| x * whole(n)).collect())
        .collect();
    Ok(PieceMeasures {
        degree: n,
        second: Norms::of(differences(&edges)),
        derivative_second: Norms::of(differences(&differences(&scaled))),
        longest_edge_squared: lengths.iter().max().cloned().unwrap_or_default(),
        shortest_edge_squared: lengths.iter().min().cloned().unwrap_or_default(),
    })
}

/// The bounds of a composite curve in one norm, squared: the greatest over its pieces.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bounds {
    /// K² with K = max N∞(n)·‖Δ₂P‖: after m subdivisions |c − L| ≤ K/4^m.
    pub distance_squared: Rational,
    /// Q² with Q = max N∞(n−1)·‖Δ₂(ΔP)‖: after m subdivisions |c' − D_m| ≤ Q/4^m.
    pub derivative_squared: Rational,
    /// X² with X = max n·N∞(n−1)·‖Δ₂(ΔP)‖, of which CPJ12 print the half: |c' − D_m| ≤ X/(2·4^m), for n ≥ 2 never less than the bound above.
    pub derivative_printed_squared: Rational,
    /// The square of ℓ₀, the longest edge of the control polygons.
    pub longest_edge_squared: Rational,
}

/// The bounds of pieces that were measured.
pub fn bounds(pieces: &[PieceMeasures], norm: Norm) -> Bounds {
    let greatest = |square: &dyn Fn(&PieceMeasures) -> Rational| pieces.iter().map(square).max().unwrap_or_default();
    let square = |x: Rational| &x * &x;
    let factor = |piece: &PieceMeasures| square(nairn_peters_lutterkort(piece.degree - 1));
    Bounds {
        distance_squared: greatest(&|piece| square(nairn_peters_lutterkort(piece.degree)) * piece.second.squared(norm)),
        derivative_squared: greatest(&|piece| factor(piece) * piece.derivative_second.squared(norm)),
        derivative_printed_squared: greatest(&|piece| {
            factor(piece) * square(whole(piece.degree)) * piece.derivative_second.squared(norm)
        }),
        longest_edge_squared: greatest(&|piece| piece.longest_edge_squared.clone()),
    }
}

/// v_{k+1} − v_k.
pub(super) fn differences(vectors: &[Vec<Rational>]) -> Vec<Vec<Rational>> {
    vectors
        .windows(2)
        .map(|pair| pair[1].iter().zip(&pair[0]).map(|(x, y)| x - y).collect())
        .collect()
}

/// |v|².
pub(super) fn squared_length(vector: &[Rational]) -> Rational {
    vector.iter().fold(Rational::default(), |sum, x| sum + x * x)
}

/// |x|.
pub(super) fn absolute(x: Rational) -> Rational {
    if x.numer().is_negative() { -x } else { x }
}

/// An integer as a fraction.
pub(super) fn whole(n: usize) -> Rational {
    Rational::from_integer(Integer::from(n))
}
