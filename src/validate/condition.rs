//! How sensitive derivatives are to rounding: the sizes that units in the last place are made of.
//!
//! These sizes are computed in binary64: they say how coarse a deviation is counted, not whether a result is exact.

use crate::curve::{BSpline, Bezier, Curve, bernstein};
use crate::engine::FloatCurve;
use crate::number::{Rational, RationalExt, RationalVector};

/// The derivatives at a parameter, exactly, on one side, with the size of what they are computed from.
#[derive(Debug, Clone)]
pub(super) struct Condition {
    /// The point and the derivatives.
    pub(super) derivatives: Vec<Vec<Rational>>,
    /// For each the size: a relative error ε in every number on the way moves it by about ε times this.
    pub(super) sizes: Vec<f64>,
}

impl Condition {
    /// The largest magnitude of a coordinate of the control points; 1 when all are zero.
    pub(super) fn scale(curve: &FloatCurve) -> f64 {
        match curve.points.iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs())) {
            0.0 => 1.0,
            scale => scale,
        }
    }

    /// One entry for each side of the parameter where that is a knot, or two units in the last place beside one: which piece a parameter as
    /// near as that belongs to is a matter of rounding.
    pub(super) fn new(
        curve: &FloatCurve,
        spline: &BSpline,
        t: &Rational,
        order: usize,
    ) -> Result<Vec<Condition>, String> {
        let scale = Condition::scale(curve);
        let size = curve.knots.iter().fold(0.0_f64, |most, t| most.max(t.abs()));
        let slack = Rational::from_f64(size * 2.0 * f64::EPSILON).ok_or("the knots are too large")?;
        let owned = Curve::from(spline.clone());
        let chain = owned.chain();
        let mut choices = Vec::new();
        for i in 0..chain.count() {
            let Some(piece) = chain.piece(i) else { continue };
            let (start, end) = &piece.knots;
            if *t < start - &slack || *t > end + &slack {
                continue;
            }
            let length = end - start;
            let inside = t.clone().max(start.clone()).min(end.clone());
            let u = (inside - start) / &length;
            let mut derivatives = piece.bezier.derivatives(&u, order).map_err(|e| e.to_string())?;
            let mut factor = Rational::from_integer(1.into());
            for vector in &mut derivatives {
                for x in vector {
                    *x *= &factor;
                }
                factor /= &length;
            }
            let sizes = sizes(piece.bezier, &u, length.to_f64(), order, scale);
            choices.push(Condition { derivatives, sizes });
        }
        Ok(choices)
    }

    fn norm(&self, order: usize) -> f64 {
        let squares = self.derivatives[order].iter().map(|x| x.to_f64().powi(2));
        squares.fold(0.0, |sum, x| sum + x).sqrt()
    }
}

/// Sizes of c, c', …: with the control points replaced by the scale and every difference by a sum.
///
/// For polynomial pieces that is scale · n! / (n − k)! · (2 / length)^k. Rational ones follow the quotient rule
/// c⁽ᵏ⁾ = (N⁽ᵏ⁾ − Σ C(k, i) W⁽ⁱ⁾ c⁽ᵏ⁻ⁱ⁾) / W with every term counted positive.
fn sizes(piece: &Bezier, u: &Rational, length: f64, order: usize, scale: f64) -> Vec<f64> {
    let n = piece.degree();
    let weights = match piece.weights() {
        None => vec![1.0; n + 1],
        Some(weights) => RationalVector::to_f64s(weights),
    };
    // Ŵ⁽ᵏ⁾: the k-th differences of the weights with all signs positive, at u.
    let mut sums = weights;
    let mut factor = 1.0;
    let mut absolute = Vec::with_capacity(order + 1);
    for k in 0..=order {
        if k > n {
            absolute.push(0.0);
            continue;
        }
        if k > 0 {
            sums = sums.windows(2).map(|pair| pair[0] + pair[1]).collect();
            factor *= (n + 1 - k) as f64 / length;
        }
        let values = bernstein(n - k, u);
        let at: f64 = values.iter().zip(&sums).fold(0.0, |sum, (b, w)| sum + b.to_f64() * w);
        absolute.push(factor * at);
    }
    let mut sizes: Vec<f64> = Vec::with_capacity(order + 1);
    for k in 0..=order {
        let mut size = scale * absolute[k];
        if !piece.is_polynomial() {
            let mut binomial = 1.0;
            for i in 1..=k {
                binomial *= (k + 1 - i) as f64 / i as f64;
                size += binomial * absolute[i] * sizes[k - i];
            }
        }
        sizes.push(size / absolute[0]);
    }
    sizes
}

/// By how much κ = |c' × c''| / |c'|³ moves when c' and c'' move by their sizes.
pub(super) fn curvature_unit(at: &Condition, curvature: f64) -> f64 {
    let (first, second) = (at.norm(1), at.norm(2));
    (at.sizes[1] * second + first * at.sizes[2]) / first.powi(3) + 3.0 * curvature * at.sizes[1] / first
}

/// The same of τ = det(c', c'', c''') / area², area = |c' × c''|.
pub(super) fn torsion_unit(at: &Condition, torsion: f64, area: f64) -> f64 {
    let (a, b, c) = (at.norm(1), at.norm(2), at.norm(3));
    let volume = at.sizes[1] * b * c + a * at.sizes[2] * c + a * b * at.sizes[3];
    let change = at.sizes[1] * b + a * at.sizes[2];
    volume / (area * area) + 2.0 * torsion * change / area
}
