//! Curvature and torsion, in double-double.

use super::curve::Curve;
use super::double::Double;
use super::error::FloatError;
use crate::curve::Side;

/// A determinant below this part of the product of the lengths of its vectors is rounding of an exact zero, or cannot be told from it.
const NOISE: f64 = 1e-22;

/// First and second derivatives that are parallel up to this part of their lengths give no torsion.
const PARALLEL: f64 = 1e-13;

/// 2⁻⁹⁶.
const ROUNDING: f64 = 1.0 / (1_u128 << 96) as f64;

impl Curve {
    /// The curvature |c' × c''| / |c'|³, never negative, at the domain parameter `t`, from the given side where t is a knot.
    ///
    /// # Errors
    /// [`FloatError::OutsideDomain`]; [`FloatError::Irregular`] where c' is 0 or cannot be told from 0; [`FloatError::Range`] when the result is not
    /// finite.
    pub fn curvature(&self, t: f64, side: Side) -> Result<f64, FloatError> {
        let all = self.double_derivatives(t, side, 2)?;
        self.check_regular(t, side, &all)?;
        let (first, second) = (unit_scaled(&all[1])?, scaled(&all[2]));
        let (Some((second, second_exponent)), (first, first_exponent)) = (second, first) else {
            return Ok(0.0);
        };
        let normal = cross(&first, &second);
        let speed_squared = dot(&first, &first);
        let square = dot(&normal, &normal);
        if square.value() <= NOISE * NOISE * (speed_squared * dot(&second, &second)).value() {
            return Ok(0.0);
        }
        let value = (square.sqrt() / (speed_squared * speed_squared.sqrt())).value();
        in_range(times_power(value, second_exponent - 2 * first_exponent))
    }

    /// The torsion det(c', c'', c''') / |c' × c''|² of a curve in space, positive for a right-handed helix, from the given side where t is a knot.
    ///
    /// # Errors
    /// [`FloatError::Dimension`] in the plane; [`FloatError::Irregular`] where c' and c'' are parallel to 10⁻¹³; otherwise as for [`Curve::curvature`].
    pub fn torsion(&self, t: f64, side: Side) -> Result<f64, FloatError> {
        if self.dimension != 3 {
            return Err(FloatError::Dimension);
        }
        let all = self.double_derivatives(t, side, 3)?;
        self.check_regular(t, side, &all)?;
        let (first, first_exponent) = unit_scaled(&all[1])?;
        let (second, second_exponent) = unit_scaled(&all[2])?;
        let normal = cross(&first, &second);
        let square = dot(&normal, &normal);
        if square.value() <= PARALLEL * PARALLEL * (dot(&first, &first) * dot(&second, &second)).value() {
            return Err(FloatError::Irregular);
        }
        let Some((third, third_exponent)) = scaled(&all[3]) else {
            return Ok(0.0);
        };
        let determinant = dot(&normal, &third);
        if determinant.value().abs() <= NOISE * (square.value() * dot(&third, &third).value()).sqrt() {
            return Ok(0.0);
        }
        let value = (determinant / square).value();
        in_range(times_power(value, third_exponent - first_exponent - second_exponent))
    }

    /// Refuses a first derivative that may be rounding of 0: one below 2⁻⁹⁶ of the terms it is made of.
    ///
    /// c' = ((wc)' − w'c) / w, and (wc)' and w' are convex combinations of the differences of control points, times p over the length of the knots they
    /// act on. The terms of those differences bound what rounding in double-double, at most 2⁻¹⁰⁰ a step, leaves of a sum that is 0.
    fn check_regular(&self, t: f64, side: Side, derivatives: &[[Double; 3]]) -> Result<(), FloatError> {
        let (k, p, d) = (self.span(t, side)?, self.degree, self.dimension);
        let size = |vector: &[Double; 3]| vector.iter().fold(0.0, |most: f64, x| most.max(x.value().abs()));
        let place = size(&derivatives[0]);
        let term = |i: usize| {
            let point = self.points[i * d..(i + 1) * d].iter();
            let most = point.fold(0.0, |most: f64, x| most.max(x.abs()));
            match &self.weights {
                Some(weights) => weights[i] * (most + place),
                None => most,
            }
        };
        let terms = (k - p..k)
            .map(|i| p as f64 / (self.knots[i + 1 + p] - self.knots[i + 1]) * (term(i) + term(i + 1)))
            .fold(0.0, f64::max);
        let weight = match &self.weights {
            Some(_) => self.lifted_point(k, t)[3].value(),
            None => 1.0,
        };
        if size(&derivatives[1]) <= ROUNDING * terms / weight {
            return Err(FloatError::Irregular);
        }
        Ok(())
    }
}

/// A vector divided by the power of two that brings it near length 1, and its exponent; nothing for zero.
fn scaled(vector: &[Double; 3]) -> Option<([Double; 3], i32)> {
    let greatest = vector.iter().fold(0.0, |most: f64, x| most.max(x.value().abs()));
    if greatest == 0.0 || !greatest.is_finite() {
        return None;
    }
    let exponent = greatest.log2().floor() as i32;
    let half = exponent / 2;
    let scale = |x: Double| x.times(2f64.powi(-half)).times(2f64.powi(half - exponent));
    Some((vector.map(scale), exponent))
}

fn unit_scaled(vector: &[Double; 3]) -> Result<([Double; 3], i32), FloatError> {
    if vector.iter().any(|x| !x.value().is_finite()) {
        return Err(FloatError::Range { place: "result" });
    }
    scaled(vector).ok_or(FloatError::Irregular)
}

fn times_power(value: f64, exponent: i32) -> f64 {
    let half = (exponent / 2).clamp(-1000, 1000);
    value * 2f64.powi(half) * 2f64.powi((exponent - half).clamp(-1000, 1000))
}

fn in_range(value: f64) -> Result<f64, FloatError> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(FloatError::Range { place: "result" })
    }
}

fn dot(a: &[Double; 3], b: &[Double; 3]) -> Double {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: &[Double; 3], b: &[Double; 3]) -> [Double; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
