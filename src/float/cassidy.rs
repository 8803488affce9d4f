//! The estimate of Cassidy, Peters and Jordan (2012) for the minimum separation distance, from the control polygon after m subdivisions.

use super::FloatError;
use super::curve::Curve;
use super::piece::{Pieces, Vector, affine, dot, greatest, middle, sub};
use super::tree::halve;

/// The estimate λ with what it was computed from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// λ, the least distance of two edges that pass the double-normal test, or nothing when none does.
    pub distance: Option<f64>,
    /// The subdivisions m = max(m₁, m₂).
    pub subdivisions: u32,
    /// Edges of the polygon.
    pub edges: usize,
    /// ε, by which the polygon may differ from the curve.
    pub epsilon: f64,
    /// E = ε²/2 + ℓ₀²/2^{2m−1}. The paper derives |σ − λ| ≤ E for polygons with edges of length at least 1, which is no bound otherwise.
    pub printed_error: f64,
    /// 2·√(ε²/4 + ℓ₀²/2^{2m}), what the derivation gives without that assumption.
    pub derived_error: f64,
}

/// An edge with the parameters of its hodograph polygon at its ends.
struct Edge {
    start: Vector,
    end: Vector,
    /// The discrete derivative at the start and at the end.
    derivatives: (Vector, Vector),
}

/// ⌊n/2⌋⌈n/2⌉/(2n) (Nairn, Peters and Lutterkort 1999).
pub(super) fn polygon_constant(n: usize) -> f64 {
    (n / 2) as f64 * n.div_ceil(2) as f64 / (2.0 * n as f64)
}

/// The greatest maximum norm of a second difference.
fn second_difference(points: &[Vector]) -> f64 {
    let of = |w: &[Vector]| greatest(&std::array::from_fn(|i| w[0][i] - 2.0 * w[1][i] + w[2][i]));
    points.windows(3).map(of).fold(0.0, f64::max)
}

/// The number of subdivisions after which `bound`/4^m is at most `epsilon`.
fn subdivisions(bound: f64, epsilon: f64) -> u32 {
    if bound <= epsilon {
        0
    } else {
        (0.5 * (bound / epsilon).log2()).ceil() as u32
    }
}

impl Curve {
    /// The estimate of MSD with the greatest error `delta` asked for and the tolerance `normal` of the double-normal test.
    ///
    /// ε is half the positive root of (3), m follows from (1) and (2). Edges that share an end are not compared.
    ///
    /// # Errors
    /// [`FloatError::Argument`] when `delta` or `normal` is not positive, or more than 20,000 edges would be needed; [`FloatError::Irregular`] for a
    /// rational curve, for which the bounds (1) and (2) do not hold.
    pub fn estimated_separation(&self, delta: f64, normal: f64) -> Result<Estimate, FloatError> {
        if !(delta > 0.0 && normal > 0.0 && delta.is_finite()) {
            return Err(FloatError::Argument {
                expected: "positive tolerances",
            });
        }
        let pieces = Pieces::new(self, &middle(self));
        if pieces.all.iter().any(|piece| piece.rational) {
            return Err(FloatError::Irregular);
        }
        let n = self.degree;
        let polygons: Vec<Vec<Vector>> = pieces
            .all
            .iter()
            .map(|piece| piece.control.iter().map(affine).collect())
            .collect();
        let hodograph = |points: &[Vector]| -> Vec<Vector> {
            points
                .windows(2)
                .map(|pair| sub(&pair[1], &pair[0]).map(|x| x * n as f64))
                .collect()
        };
        let longest = |polygon: &Vec<Vector>| {
            let squares = polygon.windows(2).map(|pair| sub(&pair[1], &pair[0]));
            squares.map(|x| dot(&x, &x)).fold(0.0, f64::max)
        };
        // ℓ₀².
        let edge = polygons.iter().map(longest).fold(0.0, f64::max);
        let bend = polygons
            .iter()
            .map(|polygon| second_difference(polygon))
            .fold(0.0, f64::max);
        let turn = polygons
            .iter()
            .map(|polygon| second_difference(&hodograph(polygon)))
            .fold(0.0, f64::max);
        let k = polygon_constant(n) * bend;
        // ε²/2 + 2ℓ₀²ε/K − δ = 0, half its positive root; written without cancellation.
        let epsilon = if k > 0.0 {
            let b = 2.0 * edge / k;
            delta / (b + (b * b + 2.0 * delta).sqrt())
        } else {
            (2.0 * delta).sqrt() / 2.0
        };
        let first = subdivisions(k, epsilon);
        let second = if n >= 2 {
            subdivisions(polygon_constant(n - 1) * n as f64 * turn / 2.0, epsilon)
        } else {
            0
        };
        let m = first.max(second);
        let count = (1usize << m.min(20)) * n * pieces.all.len();
        if count > 20_000 {
            return Err(FloatError::Argument {
                expected: "tolerances that need at most 20,000 edges",
            });
        }
        let scale = 2f64.powi(m as i32);
        let mut edges = Vec::with_capacity(count);
        for polygon in &polygons {
            for part in halved(polygon, m) {
                // By the parameter of the whole piece.
                let own: Vec<Vector> = hodograph(&part).iter().map(|x| x.map(|x| x * scale)).collect();
                for (i, pair) in part.windows(2).enumerate() {
                    let at = |u: f64| discrete(&own, u);
                    let derivatives = (at(i as f64 / n as f64), at((i + 1) as f64 / n as f64));
                    let [start, end] = [pair[0], pair[1]];
                    edges.push(Edge {
                        start,
                        end,
                        derivatives,
                    });
                }
            }
        }
        let least = least_distance(&edges, pieces.closed, normal);
        let sides = edge / scale / scale;
        Ok(Estimate {
            distance: least,
            subdivisions: m,
            edges: edges.len(),
            epsilon,
            printed_error: epsilon * epsilon / 2.0 + 2.0 * sides,
            derived_error: 2.0 * (epsilon * epsilon / 4.0 + sides).sqrt(),
        })
    }
}

/// The control polygons after `m` halvings.
fn halved(polygon: &[Vector], m: u32) -> Vec<Vec<Vector>> {
    let mut parts = vec![polygon.to_vec()];
    for _ in 0..m {
        parts = parts
            .into_iter()
            .flat_map(|mut right| {
                let left = halve(&mut right);
                [left, right]
            })
            .collect();
    }
    parts
}

/// The uniformly parametrised polygon through some points, at 0 ≤ u ≤ 1.
fn discrete(points: &[Vector], u: f64) -> Vector {
    let last = points.len() - 1;
    if last == 0 {
        return points[0];
    }
    let at = u * last as f64;
    let i = (at.floor() as usize).min(last - 1);
    mix(&points[i], &points[i + 1], at - i as f64)
}

fn mix(a: &Vector, b: &Vector, u: f64) -> Vector {
    std::array::from_fn(|i| a[i] + u * (b[i] - a[i]))
}

/// The least distance of two edges without a common end whose connection passes the double-normal test.
fn least_distance(edges: &[Edge], closed: bool, normal: f64) -> Option<f64> {
    let mut least: Option<f64> = None;
    for (i, a) in edges.iter().enumerate() {
        for (j, b) in edges.iter().enumerate().skip(i + 2) {
            if closed && i == 0 && j == edges.len() - 1 {
                continue;
            }
            let (u, v) = nearest(a, b);
            let x = sub(&mix(&a.start, &a.end, u), &mix(&b.start, &b.end, v));
            let distance = dot(&x, &x).sqrt();
            if least.is_some_and(|least| distance >= least) {
                continue;
            }
            let passes = |edge: &Edge, u: f64| {
                let derivative = mix(&edge.derivatives.0, &edge.derivatives.1, u);
                dot(&x, &derivative).abs() <= normal * distance
            };
            if passes(a, u) && passes(b, v) {
                least = Some(distance);
            }
        }
    }
    least
}

/// The parameters of the nearest points of two segments (Ericson 2005, §5.1.9).
fn nearest(a: &Edge, b: &Edge) -> (f64, f64) {
    let (p, q, x) = (sub(&a.end, &a.start), sub(&b.end, &b.start), sub(&a.start, &b.start));
    let (pp, qq, px, qx, pq) = (dot(&p, &p), dot(&q, &q), dot(&p, &x), dot(&q, &x), dot(&p, &q));
    let ratio = |x: f64, y: f64| if y > 0.0 { (x / y).clamp(0.0, 1.0) } else { 0.0 };
    let u = ratio(pq * qx - px * qq, pp * qq - pq * pq);
    let v = (pq * u + qx) / if qq > 0.0 { qq } else { 1.0 };
    if v < 0.0 {
        (ratio(-px, pp), 0.0)
    } else if v > 1.0 {
        (ratio(pq - px, pp), 1.0)
    } else {
        (u, v)
    }
}
