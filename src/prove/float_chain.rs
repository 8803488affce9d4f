//! The chain in binary64, with a proved bound of its errors.
//!
//! **Error bound.** Let u = 2^-53. A coordinate p/q of a polynomial piece becomes fl(fl(p)·fl(1/fl(q))), off by at most 4u|p/q| (four roundings of relative
//! error u and their products). Halving takes means (a+b)/2 only: a mean of two numbers that are each off by at most e is off by at most e plus the
//! rounding u·M of one addition (the division by two is exact but for underflow), with M the greatest magnitude of the coefficients, which means never exceed. A halving of degree n
//! takes at most n means in a row. So after k halvings every coefficient is off by at most (4 + nk)·u·M·(1 + small), and the bound used, (4 + nk)·2u·M, leaves
//! a factor of two for the higher-order terms (nk·u < 10^-12 for all degrees and depths allowed here). Underflow is covered by adding the least normal number.
//!
//! For a rational piece this holds of X and w, and P = X/w is off by at most (e_X + |P|e_w)/(w − e_w) + 2u|P|.

use smallvec::SmallVec;

use super::cone::Cone;
use super::vector::{Vector, greatest, sub};
use crate::check::chain::{Chain, Scale, ScaleRef};
use crate::check::word::Word;
use crate::number::Integer;

/// 2^-52, twice the unit roundoff.
pub const UNIT: f64 = f64::EPSILON;

/// One piece: where its coefficients are and how large they are.
#[derive(Clone, Copy, Debug)]
pub struct FloatPiece {
    /// Degree n.
    pub degree: usize,
    /// Degree of D.
    pub tangent_degree: usize,
    /// Has unequal weights: its points are (X, w), else (P, 1).
    pub rational: bool,
    start: usize,
    /// Greatest magnitude of a coordinate of X (P for a polynomial piece).
    pub greatest_point: f64,
    /// Greatest weight, 1 for a polynomial piece.
    pub greatest_weight: f64,
    /// Greatest magnitude of a component of D.
    pub greatest_tangent: f64,
    /// Cone of all tangents.
    pub cone: Cone,
}

/// All pieces.
pub struct FloatChain {
    /// The pieces.
    pub pieces: Vec<FloatPiece>,
    /// Do the ends coincide?
    pub closed: bool,
    coefficients: Vec<Vector>,
}

/// `value`·2^`exponent`, saturating.
fn times_power(value: f64, exponent: i64) -> f64 {
    // Two steps, so that intermediate powers stay finite.
    let half = (exponent / 2).clamp(-1000, 1000) as i32;
    let rest = (exponent - i64::from(half)).clamp(-1022, 1023) as i32;
    value * 2f64.powi(half) * 2f64.powi(rest)
}

/// An integer over a scale, as a float of relative error at most 4u (short of underflow).
pub fn quotient<W: Word>(value: &W, scale: ScaleRef) -> f64 {
    let (odd, odd_exponent) = scale.odd.to_f64_exponent();
    match value.to_i128().map(i64::try_from) {
        Some(Ok(small)) => times_power(small as f64 / odd, -odd_exponent - i64::from(scale.exponent)),
        _ => {
            let (mantissa, exponent) = value.to_integer().to_f64_exponent();
            times_power(mantissa / odd, exponent - odd_exponent - i64::from(scale.exponent))
        }
    }
}

impl FloatChain {
    /// The chain in floats. Pieces whose numbers leave the range of binary64 get infinite magnitudes, so that nothing is decided by them.
    pub fn new(chain: &Chain) -> Self {
        let size: usize = chain
            .pieces
            .iter()
            .map(|piece| piece.degree + piece.tangent_degree + 2)
            .sum();
        let mut floats = FloatChain {
            pieces: Vec::with_capacity(chain.count()),
            closed: chain.closed,
            coefficients: Vec::with_capacity(size),
        };
        for piece in 0..chain.count() {
            match chain.pieces[piece].width {
                crate::check::chain::Width::Narrow => floats.push(chain, piece, &chain.narrow_numbers(piece)),
                crate::check::chain::Width::Wide => floats.push(chain, piece, &chain.wide_numbers(piece)),
                crate::check::chain::Width::Large => floats.push(chain, piece, &chain.large_numbers(piece)),
            }
        }
        floats
    }

    fn push<W: Word>(&mut self, chain: &Chain, number: usize, numbers: &crate::check::chain::Numbers<'_, W>) {
        let piece = &chain.pieces[number];
        let start = self.coefficients.len();
        // Homogeneous coordinates may be scaled by any power of two.
        let homogeneous = Scale {
            odd: Integer::from(1),
            exponent: numbers.weights.first().map_or(0, |w| w.bit_length()),
        };
        let factor = |scale: &Scale| {
            // One division for all coordinates of the piece.
            let odd = scale.odd.to_i64().filter(|_| scale.exponent < 900);
            odd.map(|odd| 2f64.powi(-(scale.exponent as i32)) / odd as f64)
        };
        let as_float = |x: &W, scale: &Scale, factor: Option<f64>| match (factor, x.to_i128().map(i64::try_from)) {
            (Some(factor), Some(Ok(small))) => small as f64 * factor,
            _ => quotient(x, scale.doubled(0)),
        };
        let point_scale = if piece.rational {
            &homogeneous
        } else {
            &piece.point_scale
        };
        let point_factor = factor(point_scale);
        for (k, point) in numbers.points.iter().enumerate() {
            let weight = if piece.rational {
                as_float(&numbers.weights[k], point_scale, point_factor)
            } else {
                1.0
            };
            let [x, y, z] = [0, 1, 2].map(|i| as_float(&point[i], point_scale, point_factor));
            self.coefficients.push([x, y, z, weight]);
        }
        let tangent_factor = factor(&piece.tangent_scale);
        for tangent in numbers.tangents {
            let [x, y, z] = [0, 1, 2].map(|i| as_float(&tangent[i], &piece.tangent_scale, tangent_factor));
            self.coefficients.push([x, y, z, 0.0]);
        }
        let all = &self.coefficients[start..];
        let (points, tangents) = all.split_at(piece.degree + 1);
        let most = |vectors: &[Vector]| {
            let most = vectors.iter().map(greatest).fold(0.0, f64::max);
            if vectors.iter().flatten().all(|x| x.is_finite()) {
                most
            } else {
                f64::INFINITY
            }
        };
        self.pieces.push(FloatPiece {
            degree: piece.degree,
            tangent_degree: piece.tangent_degree,
            rational: piece.rational,
            start,
            greatest_point: most(points),
            greatest_weight: points.iter().map(|point| point[3]).fold(0.0, f64::max),
            greatest_tangent: most(tangents),
            cone: Cone::around(tangents.iter()),
        });
    }

    /// The coefficients of all pieces: for each its homogeneous control points and then those of D.
    pub fn coefficients(&self) -> &[Vector] {
        &self.coefficients
    }

    /// Where the coefficients of a piece start among those of all.
    pub fn start(&self, piece: usize) -> usize {
        self.pieces[piece].start
    }

    /// The homogeneous control points of a piece.
    pub fn points(&self, piece: usize) -> &[Vector] {
        let data = &self.pieces[piece];
        &self.coefficients[data.start..=data.start + data.degree]
    }

    /// The coefficients of D of a piece.
    pub fn tangents(&self, piece: usize) -> &[Vector] {
        let data = &self.pieces[piece];
        let start = data.start + data.degree + 1;
        &self.coefficients[start..=start + data.tangent_degree]
    }

    /// Error bounds of X (or P), w and D after a number of halvings.
    pub fn errors(&self, piece: usize, depth: u32) -> (f64, f64, f64) {
        let data = &self.pieces[piece];
        let grown =
            |degree: usize, size: f64| (4.0 + degree as f64 * f64::from(depth)) * UNIT * size + f64::MIN_POSITIVE;
        let weight = if data.rational {
            grown(data.degree, data.greatest_weight)
        } else {
            0.0
        };
        (
            grown(data.degree, data.greatest_point),
            weight,
            grown(data.tangent_degree, data.greatest_tangent),
        )
    }

    /// Position, first and second derivative by the local parameter u.
    pub fn evaluate(&self, piece: usize, u: f64) -> [Vector; 3] {
        let points = self.points(piece);
        let homogeneous = match <[Vector; 4]>::try_from(points) {
            // Without loops for cubics.
            Ok(mut row) => evaluate_row(&mut row, u),
            Err(_) => {
                let mut row: SmallVec<[Vector; 8]> = SmallVec::from_slice(points);
                evaluate_row(&mut row, u)
            }
        };
        if !self.pieces[piece].rational {
            return homogeneous;
        }
        let [position, first, second] = homogeneous;
        // With X = wc: X' = w'c + wc', X'' = w''c + 2w'c' + wc''.
        let w = position[3];
        let c = super::vector::scale(&position, 1.0 / w);
        let d = [0, 1, 2].map(|i| (first[i] - first[3] * c[i]) / w);
        let e = [0, 1, 2].map(|i| (second[i] - second[3] * c[i] - 2.0 * first[3] * d[i]) / w);
        [c, [d[0], d[1], d[2], 0.0], [e[0], e[1], e[2], 0.0]]
    }
}

/// De Casteljau at u, in place: the value and its first two derivatives.
#[inline(always)]
fn evaluate_row(row: &mut [Vector], u: f64) -> [Vector; 3] {
    let degree = row.len() - 1;
    let step = |row: &mut [Vector], count: usize| {
        for i in 0..count {
            for axis in 0..4 {
                row[i][axis] += u * (row[i + 1][axis] - row[i][axis]);
            }
        }
    };
    for count in (2..degree).rev() {
        step(row, count + 1);
    }
    let n = degree as f64;
    let second = if degree >= 2 {
        let difference = sub(&sub(&row[2], &row[1]), &sub(&row[1], &row[0]));
        super::vector::scale(&difference, n * (n - 1.0))
    } else {
        [0.0; 4]
    };
    if degree >= 2 {
        step(row, 2);
    }
    let first = super::vector::scale(&sub(&row[1], &row[0]), n);
    step(row, 1);
    [row[0], first, second]
}
