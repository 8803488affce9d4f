//! Points of a curve: de Boor's algorithm.

use super::curve::{Curve, Lifted, parts};
use super::double::Double;
use super::error::FloatError;
use crate::curve::{MAXIMUM_DEGREE, Side};

/// In binary64 a point is off by a few units of the greatest control point near it. Where the point itself is smaller than that by more than this
/// factor, double-double is used.
const CANCELLATION: f64 = 0.125;

impl Curve {
    /// The point c(t), t in the domain; z = 0 in the plane.
    ///
    /// # Errors
    /// [`FloatError::OutsideDomain`].
    pub fn point(&self, t: f64) -> Result<[f64; 3], FloatError> {
        let k = self.span(t, Side::After)?;
        Ok(self.exact_point(k, t))
    }

    /// The point of span k by de Boor's algorithm (1972) in double-double.
    pub(super) fn exact_point(&self, k: usize, t: f64) -> [f64; 3] {
        let lifted = self.lifted_point(k, t);
        self.affine(&lifted).map(Double::value)
    }

    /// The same before division and rounding.
    pub(super) fn lifted_point(&self, k: usize, t: f64) -> Lifted {
        if self.degree < 8 {
            self.lifted_point_in(k, t, &mut [[Double::ZERO; 4]; 8])
        } else {
            self.lifted_point_in(k, t, &mut [[Double::ZERO; 4]; MAXIMUM_DEGREE + 1])
        }
    }

    fn lifted_point_in(&self, k: usize, t: f64, rows: &mut [Lifted]) -> Lifted {
        let p = self.degree;
        for (j, row) in rows[..=p].iter_mut().enumerate() {
            *row = self.lifted(k - p + j);
        }
        self.de_boor(k, t, 0, rows);
        rows[0]
    }

    /// De Boor's rounds on the p − `order` + 1 coefficients of a derivative that act on span k, in place; the value is the first.
    pub(super) fn de_boor(&self, k: usize, t: f64, order: usize, rows: &mut [Lifted]) {
        let degree = self.degree - order;
        // Between knots of full multiplicity all intervals are the same.
        let mut interval = (f64::NAN, f64::NAN);
        let (mut u, mut v) = (Double::ZERO, Double::ZERO);
        for round in 1..=degree {
            for j in 0..=degree - round {
                let i = k - degree + j + round;
                let (low, high) = (self.knots[i], self.knots[i + degree + 1 - round]);
                if (low, high) != interval {
                    interval = (low, high);
                    (u, v) = parts(low, t, high);
                }
                let (head, tail) = rows.split_at_mut(j + 1);
                self.mix_into(v, &mut head[j], u, &tail[0]);
            }
        }
    }

    /// Division by the weight.
    pub(super) fn affine(&self, lifted: &Lifted) -> [Double; 3] {
        let [x, y, z, w] = *lifted;
        if self.weights.is_none() {
            return [x, y, z];
        }
        [x / w, y / w, z / w]
    }

    /// The points at many parameters, flat, `dimension` numbers each, into `points`; fastest when neighbours share a span.
    ///
    /// # Errors
    /// [`FloatError::OutsideDomain`] for the first parameter outside, and [`FloatError::Argument`] when `points` has another length; `points` is then
    /// unspecified.
    pub fn points_at(&self, parameters: &[f64], points: &mut [f64]) -> Result<(), FloatError> {
        Evaluator::new(self).points_at(parameters, points)
    }
}

/// A curve prepared for many evaluations: homogeneous control points and reciprocals of knot differences.
///
/// Evaluation allocates nothing. A point is computed in binary64 where that is safe and in double-double where the terms cancel.
pub struct Evaluator<'a> {
    curve: &'a Curve,
    /// (w P, w), or (P, 1).
    control: Vec<[f64; 4]>,
    /// The greatest magnitude of a coordinate of each control point.
    magnitudes: Vec<f64>,
    /// 1/(t_{i+r} − t_i) at i·p + r − 1, for degrees up to [`TABLE_DEGREE`] of more than one span.
    reciprocals: Vec<f64>,
    /// One span, both ends with p + 1 knots: t_n − t_p.
    bezier: Option<f64>,
}

/// Up to this degree reciprocals are stored.
const TABLE_DEGREE: usize = 7;

impl<'a> Evaluator<'a> {
    /// Prepares a curve.
    pub fn new(curve: &'a Curve) -> Evaluator<'a> {
        let (p, n, d) = (curve.degree, curve.count(), curve.dimension);
        let mut control = Vec::with_capacity(n);
        let mut magnitudes = Vec::with_capacity(n);
        for i in 0..n {
            let mut point = [0.0, 0.0, 0.0, 1.0];
            point[..d].copy_from_slice(&curve.points[i * d..(i + 1) * d]);
            magnitudes.push(greatest(&point));
            if let Some(weights) = &curve.weights {
                point[3] = weights[i];
                for x in &mut point[..3] {
                    *x *= weights[i];
                }
            }
            control.push(point);
        }
        let (start, end) = curve.domain();
        let bezier = (n == p + 1 && curve.knots[0] == start && curve.knots[n + p] == end).then_some(end - start);
        let mut reciprocals = Vec::new();
        if bezier.is_none() && p <= TABLE_DEGREE {
            reciprocals.reserve_exact(p * curve.knots.len());
            for i in 0..curve.knots.len() {
                for r in 1..=p {
                    let high = curve.knots.get(i + r).copied().unwrap_or(f64::NAN);
                    reciprocals.push(1.0 / (high - curve.knots[i]));
                }
            }
        }
        Evaluator {
            curve,
            control,
            magnitudes,
            reciprocals,
            bezier,
        }
    }

    /// The point c(t), t in the domain; z = 0 in the plane.
    ///
    /// # Errors
    /// [`FloatError::OutsideDomain`].
    #[inline]
    pub fn point(&self, t: f64) -> Result<[f64; 3], FloatError> {
        let k = self.curve.span(t, Side::After)?;
        Ok(self.point_of_span(k, t))
    }

    /// The points at many parameters, as [`Curve::points_at`].
    ///
    /// # Errors
    /// As for [`Curve::points_at`].
    pub fn points_at(&self, parameters: &[f64], points: &mut [f64]) -> Result<(), FloatError> {
        let d = self.curve.dimension;
        if parameters.len() * d != points.len() {
            return Err(FloatError::Argument {
                expected: "room for as many points as there are parameters",
            });
        }
        let mut k = self.curve.degree;
        for (t, point) in parameters.iter().zip(points.chunks_exact_mut(d)) {
            k = self.curve.span_near(*t, Side::After, k)?;
            point.copy_from_slice(&self.point_of_span(k, *t)[..d]);
        }
        Ok(())
    }

    #[inline]
    fn point_of_span(&self, k: usize, t: f64) -> [f64; 3] {
        match (self.curve.degree, &self.curve.weights) {
            (1, None) => self.checked::<2, false>(k, t),
            (2, None) => self.checked::<3, false>(k, t),
            (3, None) => self.checked::<4, false>(k, t),
            (4, None) => self.checked::<5, false>(k, t),
            (5, None) => self.checked::<6, false>(k, t),
            (1, Some(_)) => self.checked::<2, true>(k, t),
            (2, Some(_)) => self.checked::<3, true>(k, t),
            (3, Some(_)) => self.checked::<4, true>(k, t),
            (4, Some(_)) => self.checked::<5, true>(k, t),
            (5, Some(_)) => self.checked::<6, true>(k, t),
            // Rounding errors grow with the degree: beyond these double-double from the start.
            _ => self.curve.exact_point(k, t),
        }
    }

    /// A point of a curve of order N = p + 1 in binary64, or in double-double where it is small beside its control points.
    #[inline(always)]
    fn checked<const N: usize, const RATIONAL: bool>(&self, k: usize, t: f64) -> [f64; 3] {
        let first = k + 1 - N;
        let basis = self.basis::<N>(k, t);
        let control: &[[f64; 4]; N] = self.control[first..=k].try_into().expect("the points of a span");
        let mut sum = [0.0; 4];
        for (b, point) in basis.iter().zip(control) {
            for axis in 0..4 {
                sum[axis] += b * point[axis];
            }
        }
        let mut point = [sum[0], sum[1], sum[2]];
        if RATIONAL {
            point = point.map(|x| x / sum[3]);
        }
        let magnitudes: &[f64; N] = self.magnitudes[first..=k].try_into().expect("the points of a span");
        let most = magnitudes.iter().fold(0.0, |most, x| if *x > most { *x } else { most });
        if greatest(&[point[0], point[1], point[2], 0.0]) < CANCELLATION * most {
            return self.curve.exact_point(k, t);
        }
        point
    }

    /// The N basis functions of span k at t, by the recursion of Cox and de Boor: sums of positive terms only.
    #[inline(always)]
    fn basis<const N: usize>(&self, k: usize, t: f64) -> [f64; N] {
        let mut basis = [0.0; N];
        basis[0] = 1.0;
        if let Some(length) = self.bezier {
            let (start, end) = self.curve.domain();
            let (mut u, mut v) = (t - start, end - t);
            if length != 1.0 {
                u /= length;
                v /= length;
            }
            for degree in 1..N {
                let mut carried = 0.0;
                for b in &mut basis[..degree] {
                    let old = *b;
                    *b = carried + v * old;
                    carried = u * old;
                }
                basis[degree] = carried;
            }
            return basis;
        }
        let p = N - 1;
        let knots = &self.curve.knots[k + 1 - p..=k + p];
        let table = &self.reciprocals[(k + 1 - p) * p..(k + 1) * p];
        for degree in 1..N {
            let mut carried = 0.0;
            for j in 0..degree {
                // The interval from knot k + 1 − degree + j, `degree` knots long.
                let low = p - degree + j;
                let scaled = basis[j] * table[low * p + degree - 1];
                basis[j] = carried + (knots[low + degree] - t) * scaled;
                carried = (t - knots[low]) * scaled;
            }
            basis[degree] = carried;
        }
        basis
    }
}

#[inline(always)]
fn greatest(point: &[f64; 4]) -> f64 {
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    larger(larger(point[0].abs(), point[1].abs()), point[2].abs())
}
