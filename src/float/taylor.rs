//! The polynomial of a span in powers of t − m, m the middle of the span, and bounds for the error of its evaluation.
//!
//! Notation: ε = 2⁻⁵³; n the degree; A_i the exact coefficient of (t − m)ⁱ, each coordinate for itself; U the greatest |t − m| on the span;
//! p̃ = Σ |A_i| Uⁱ; M the greatest magnitude of a control point that acts on the span.
//!
//! *Horner's scheme in binary64.* The rounded coefficient, the rounded difference t − m and the n steps multiply A_i (t − m)ⁱ by at most 3i + 2 factors
//! 1 + δ with |δ| ≤ ε. So the error is at most B = ε Σ (3i + 2) |A_i| Uⁱ, to first order, and at most [`UNITS`]·2⁻⁵² of the result wherever that is
//! at least B / (2ε·[`UNITS`]).
//!
//! *The compensated scheme* (Graillat, Langlois and Louvet 2005) carries what every step loses along; coefficients and t − m are held as sums of two
//! numbers. Its error is below ε|c| + B', B' = (6n + 8)² ε² p̃ + 2⁻⁹² M; the last term is for the coefficients, which are exact to double-double.
//!
//! *Division by the weight* w, at least w₀ > 0, the least weight that acts on the span: with errors e and f of numerator and weight the quotient is off by
//! (e + |c| f) / (w₀ − f) and a rounding, which is again a share of |c| from some |c| on.

use super::curve::Curve;
use super::double::{Double, two_product, two_sum};

/// What is proved of [`horner`]: an error of at most so many times 2⁻⁵² of the greatest coordinate of the result.
pub(super) const UNITS: f64 = 16.0;

/// Half a unit in the last place of 1.
const HALF: f64 = f64::EPSILON / 2.0;

/// The second-order terms of the error bounds are less than this share of them; so are roundings of the bounds themselves.
const SLACK: f64 = 1.0 + 1e-9;

/// Spans whose length is outside 2^±40 are left to de Boor's algorithm: powers of it could leave the range of binary64.
const LONGEST: f64 = (1_u64 << 40) as f64;

/// A span's polynomial. Coordinates x, y, z, w; with w = 0 where there are no weights, and z = 0 in the plane.
pub(super) struct Taylor {
    /// The middle m.
    pub(super) middle: f64,
    /// From this greatest coordinate on, Horner's scheme is accurate to [`UNITS`]; infinite where it never is.
    pub(super) threshold: f64,
    /// The same for the compensated scheme, and 3 units.
    pub(super) compensated_threshold: f64,
    /// The coefficients, the highest first, rounded …
    pub(super) high: Vec<[f64; 4]>,
    /// … and what rounding took.
    pub(super) low: Vec<[f64; 4]>,
}

impl Curve {
    /// The polynomial of the span k.
    pub(super) fn taylor(&self, k: usize) -> Taylor {
        let n = self.degree;
        let (start, end) = (self.knots[k], self.knots[k + 1]);
        let middle = start + (end - start) / 2.0;
        let reach = (middle - start).max(end - middle) * SLACK;
        let mut taylor = Taylor {
            middle,
            threshold: f64::INFINITY,
            compensated_threshold: f64::INFINITY,
            high: vec![[0.0; 4]; n + 1],
            low: vec![[0.0; 4]; n + 1],
        };
        if !(1.0 / LONGEST..=LONGEST).contains(&(end - start)) {
            return taylor;
        }
        let mut factorial = 1.0_f64;
        // B, p̃ of the coordinates and of the weight.
        let (mut bound, mut size) = ([0.0; 4], [0.0; 4]);
        let mut power = 1.0;
        for (i, derivative) in self.lifted_derivatives(k, middle, n, &[0.0; 3]).iter().enumerate() {
            for axis in 0..4 {
                if axis == 3 && self.weights.is_none() {
                    continue;
                }
                let coefficient = if i < 2 {
                    derivative[axis]
                } else {
                    derivative[axis] / Double::from(factorial)
                };
                taylor.high[n - i][axis] = coefficient.value();
                taylor.low[n - i][axis] = coefficient.rest();
                let most = coefficient.value().abs() * power;
                bound[axis] += (3 * i + 2) as f64 * HALF * most;
                size[axis] += most;
            }
            factorial *= (i + 1) as f64;
            power *= reach;
        }
        let largest = |values: &[f64; 4]| values[0].max(values[1]).max(values[2]);
        let (control, weights) = self.span_magnitudes(k);
        let growth = ((6 * n + 8) * (6 * n + 8)) as f64 * HALF * HALF;
        let noise = 2f64.powi(-92);
        let compensated = [
            growth * largest(&size) + noise * control,
            growth * size[3] + noise * weights.map_or(0.0, |(_, most)| most),
        ];
        let least = weights.map(|(least, _)| least);
        taylor.threshold = threshold(largest(&bound), bound[3], least, UNITS, 1.0);
        taylor.compensated_threshold = threshold(compensated[0], compensated[1], least, 3.0, 3.0);
        taylor
    }

    /// The greatest coordinate of the lifted control points of a span, and its least and greatest weight.
    fn span_magnitudes(&self, k: usize) -> (f64, Option<(f64, f64)>) {
        let (first, last) = (k - self.degree, k);
        let points = self.points[first * self.dimension..(last + 1) * self.dimension].iter();
        let most = points.fold(0.0, |most: f64, x| most.max(x.abs()));
        let Some(weights) = &self.weights else {
            return (most, None);
        };
        let range = weights[first..=last]
            .iter()
            .fold((f64::INFINITY, 0.0), |(least, most): (f64, f64), w| {
                (least.min(*w), most.max(*w))
            });
        (most * range.1, Some(range))
    }
}

/// The least |c| for which errors `point` of the numerator and `weight` of a weight of at least `least`, with `roundings` further roundings of the result, are
/// within `units` of |c|.
fn threshold(point: f64, weight: f64, least: Option<f64>, units: f64, roundings: f64) -> f64 {
    let allowed = units * f64::EPSILON;
    // Without weights there is no division; the compensated scheme rounds once.
    let (scale, share) = match least {
        None => (1.0, if roundings > 1.0 { HALF } else { 0.0 }),
        Some(least) => {
            let rest = least - weight;
            if rest < 0.5 * least {
                return f64::INFINITY;
            }
            (1.0 / rest, weight / rest + roundings * HALF)
        }
    };
    let left = allowed - share * SLACK;
    if left < HALF {
        return f64::INFINITY;
    }
    // What is compared is the computed result, off by no more than what is allowed of it.
    let least = point * scale / left * SLACK * (1.0 + 2.0 * allowed);
    // An infinite coefficient gives NaN or infinity.
    if least.is_nan() { f64::INFINITY } else { least }
}

/// Horner's scheme.
#[inline(always)]
pub(super) fn horner<const N: usize, const L: usize>(coefficients: &[[f64; L]; N], u: f64) -> [f64; L] {
    let mut sum = coefficients[0];
    for coefficient in &coefficients[1..] {
        for axis in 0..L {
            sum[axis] = sum[axis] * u + coefficient[axis];
        }
    }
    sum
}

/// The compensated scheme at t, for coefficients `high` + `low`.
pub(super) fn compensated<const L: usize>(high: &[[f64; L]], low: &[[f64; L]], middle: f64, t: f64) -> [f64; L] {
    let (u, rest) = two_sum(t, -middle);
    let (mut sum, mut error) = (high[0], low[0]);
    for (high, low) in high[1..].iter().zip(&low[1..]) {
        for axis in 0..L {
            let (product, lost) = two_product(sum[axis], u);
            let (next, more) = two_sum(product, high[axis]);
            error[axis] = error[axis] * u + (sum[axis] * rest + low[axis] + (lost + more));
            sum[axis] = next;
        }
    }
    std::array::from_fn(|axis| sum[axis] + error[axis])
}

#[inline(always)]
pub(super) fn greatest(point: &[f64; 3]) -> f64 {
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    larger(larger(point[0].abs(), point[1].abs()), point[2].abs())
}
