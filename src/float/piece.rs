//! Bézier pieces in plain binary64, for searches.
//!
//! They are moved so that the middle of the curve is the origin, before rounding: far from the origin binary64 would lose the digits of differences.

use super::curve::Curve;
use super::double::Double;
use crate::curve::MAXIMUM_DEGREE;

/// A point or vector; z = 0 in the plane.
pub(super) type Vector = [f64; 3];

/// A homogeneous point (w P, w).
pub(super) type Homogeneous = [f64; 4];

/// One Bézier piece c(u), 0 ≤ u ≤ 1.
pub(super) struct Piece {
    /// Has weights that differ; otherwise all are 1.
    pub(super) rational: bool,
    /// The knots at its ends.
    pub(super) ends: (f64, f64),
    /// (w P, w), the greatest weight between 1 and 2.
    pub(super) control: Vec<Homogeneous>,
}

/// All pieces of a curve.
pub(super) struct Pieces {
    /// In order.
    pub(super) all: Vec<Piece>,
    /// The ends coincide, up to rounding.
    pub(super) closed: bool,
    /// The greatest magnitude of a coordinate after the move.
    pub(super) scale: f64,
}

/// The middle of the box of some points of a curve.
pub(super) fn middle(curve: &Curve) -> Vector {
    let mut result = [0.0; 3];
    for (axis, middle) in result.iter_mut().enumerate().take(curve.dimension) {
        let coordinates = curve.points.iter().skip(axis).step_by(curve.dimension);
        let (low, high) = coordinates.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
            (low.min(*x), high.max(*x))
        });
        *middle = low / 2.0 + high / 2.0;
    }
    result
}

impl Pieces {
    /// The pieces of a curve, with `origin` as the origin.
    pub(super) fn new(curve: &Curve, origin: &Vector) -> Pieces {
        let p = curve.degree;
        let mut all: Vec<Piece> = Vec::new();
        for k in p..curve.count() {
            let ends = (curve.knots[k], curve.knots[k + 1]);
            if ends.0 == ends.1 {
                continue;
            }
            let points = curve.span_points(k);
            let weights = points.iter().map(|point| point[3].value());
            let rational = curve.weights.is_some() && weights.clone().any(|w| w != points[0][3].value());
            let greatest = weights.fold(0.0, f64::max);
            let factor = if rational {
                2f64.powi(-(greatest.log2().floor() as i32))
            } else {
                1.0
            };
            let control = points
                .iter()
                .map(|point| {
                    let mut moved = [0.0, 0.0, 0.0, 1.0];
                    if rational {
                        moved[3] = point[3].value() * factor;
                    }
                    for axis in 0..3 {
                        let x = if curve.weights.is_some() && !rational {
                            point[axis] / point[3] - Double::from(origin[axis])
                        } else {
                            (point[axis] - point[3].times(origin[axis])).times(factor)
                        };
                        moved[axis] = x.value();
                    }
                    moved
                })
                .collect();
            all.push(Piece {
                rational,
                ends,
                control,
            });
        }
        let scale = all
            .iter()
            .flat_map(|piece| piece.control.iter().map(|c| greatest(&affine(c))))
            .fold(0.0, f64::max);
        let (first, last) = (affine(&all[0].control[0]), affine(&all[all.len() - 1].control[p]));
        let closed = greatest(&sub(&first, &last)) <= 4.0 * f64::EPSILON * curve.magnitude();
        Pieces { all, closed, scale }
    }
}

impl Piece {
    /// The degree n.
    pub(super) fn degree(&self) -> usize {
        self.control.len() - 1
    }

    /// The curve's parameter at the local one.
    pub(super) fn parameter(&self, u: f64) -> f64 {
        let (start, end) = self.ends;
        if u <= 0.5 {
            (start + (end - start) * u).clamp(start, end)
        } else {
            (end - (end - start) * (1.0 - u)).clamp(start, end)
        }
    }

    /// Position and first two derivatives by u.
    #[inline]
    pub(super) fn evaluate(&self, u: f64) -> [Vector; 3] {
        let count = self.control.len();
        let [position, first, second] = match count {
            4 => {
                let mut row: [Homogeneous; 4] = [self.control[0], self.control[1], self.control[2], self.control[3]];
                reduce(&mut row, u)
            }
            ..=8 => {
                let mut row = [[0.0; 4]; 8];
                row[..count].copy_from_slice(&self.control);
                reduce(&mut row[..count], u)
            }
            _ => {
                let mut row = [[0.0; 4]; MAXIMUM_DEGREE + 1];
                row[..count].copy_from_slice(&self.control);
                reduce(&mut row[..count], u)
            }
        };
        if !self.rational {
            return [position, first, second].map(|x| [x[0], x[1], x[2]]);
        }
        // With X = wc: X' = w'c + wc', X'' = w''c + 2w'c' + wc''.
        let w = position[3];
        let c: Vector = std::array::from_fn(|i| position[i] / w);
        let d: Vector = std::array::from_fn(|i| (first[i] - first[3] * c[i]) / w);
        let e = std::array::from_fn(|i| (second[i] - second[3] * c[i] - 2.0 * first[3] * d[i]) / w);
        [c, d, e]
    }

    /// The Bézier coefficients of a positive multiple of c': differences of control points, or for a rational piece w²c' (Saito, Wang and Sederberg
    /// 1995).
    pub(super) fn tangents(&self) -> Vec<Vector> {
        let n = self.degree();
        if !self.rational {
            return self
                .control
                .windows(2)
                .map(|pair| sub(&affine(&pair[1]), &affine(&pair[0])))
                .collect();
        }
        let row = binomials(n);
        let total = binomials(2 * n - 2);
        (0..=2 * n - 2)
            .map(|k| {
                let mut sum = [0.0; 3];
                for i in (k + 1).saturating_sub(n)..=k / 2 {
                    let j = k + 1 - i;
                    let (a, b) = (&self.control[i], &self.control[j]);
                    let factor = (k + 1 - 2 * i) as f64 * row[i] * row[j] / total[k];
                    for axis in 0..3 {
                        sum[axis] += factor * (b[axis] * a[3] - a[axis] * b[3]);
                    }
                }
                sum
            })
            .collect()
    }
}

/// De Casteljau's algorithm at u, in place: the value and its first two derivatives.
#[inline(always)]
fn reduce(row: &mut [Homogeneous], u: f64) -> [Homogeneous; 3] {
    let n = row.len() - 1;
    let step = |row: &mut [Homogeneous], count: usize| {
        for i in 0..count {
            for axis in 0..4 {
                row[i][axis] += u * (row[i + 1][axis] - row[i][axis]);
            }
        }
    };
    for count in (2..n).rev() {
        step(row, count + 1);
    }
    let mut second = [0.0; 4];
    if n >= 2 {
        let factor = (n * (n - 1)) as f64;
        second = std::array::from_fn(|i| factor * (row[2][i] - 2.0 * row[1][i] + row[0][i]));
        step(row, 2);
    }
    let first = std::array::from_fn(|i| n as f64 * (row[1][i] - row[0][i]));
    step(row, 1);
    [row[0], first, second]
}

/// C(n, 0) … C(n, n), rounded where they exceed 53 bits.
pub(super) fn binomials(n: usize) -> Vec<f64> {
    let mut row = vec![1.0; n + 1];
    for k in 1..=n {
        row[k] = row[k - 1] * (n + 1 - k) as f64 / k as f64;
    }
    row
}

pub(super) fn affine(c: &Homogeneous) -> Vector {
    if c[3] == 1.0 {
        [c[0], c[1], c[2]]
    } else {
        [c[0] / c[3], c[1] / c[3], c[2] / c[3]]
    }
}

#[inline(always)]
pub(super) fn sub(a: &Vector, b: &Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
pub(super) fn dot(a: &Vector, b: &Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn greatest(a: &Vector) -> f64 {
    a[0].abs().max(a[1].abs()).max(a[2].abs())
}

impl Curve {
    /// The distance between c(s) and `other`(t), the points and their difference in double-double.
    pub(super) fn accurate_distance(&self, s: f64, other: &Curve, t: f64) -> Result<f64, super::FloatError> {
        use crate::curve::Side;
        let (i, j) = (self.span(s, Side::After)?, other.span(t, Side::After)?);
        let p = self.affine(&self.lifted_point(i, s));
        let q = other.affine(&other.lifted_point(j, t));
        Ok(length(&std::array::from_fn(|axis| p[axis] - q[axis])))
    }
}

/// The length of a vector in double-double.
pub(super) fn length(x: &[Double; 3]) -> f64 {
    (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt().value()
}
