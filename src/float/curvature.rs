//! Curvature and torsion, in double-double.

use super::curve::Curve;
use super::double::Double;
use super::error::FloatError;
use crate::curve::Side;

/// A determinant below this part of the product of the lengths of its vectors is rounding of an exact zero, or cannot be told from it.
const NOISE: f64 = 1e-22;

/// First and second derivatives that are parallel up to this part of their lengths give no torsion.
const PARALLEL: f64 = 1e-13;

impl Curve {
    /// The curvature |c' × c''| / |c'|³, never negative, at the domain parameter `t`, from the given side where t is a knot.
    ///
    /// # Errors
    /// [`FloatError::OutsideDomain`]; [`FloatError::Irregular`] where c' is 0 or known to less than 2⁻⁵³ of its length, near a cusp; [`FloatError::Range`] when the result is not
    /// finite.
    pub fn curvature(&self, t: f64, side: Side) -> Result<f64, FloatError> {
        Ok(self.curvature_and_noise(t, side)?.0)
    }

    /// The curvature, and the part of |c''| / |c'|² that rounding of the derivatives may put in it.
    pub(super) fn curvature_and_noise(&self, t: f64, side: Side) -> Result<(f64, f64), FloatError> {
        let all = self.double_derivatives(t, side, 2)?;
        let relative = relative_errors(&self.derivative_errors(t, side, 2)?, &all)?;
        let (first, second) = (unit_scaled(&all[1])?, scaled(&all[2]));
        let (Some((second, second_exponent)), (first, first_exponent)) = (second, first) else {
            return Ok((0.0, NOISE));
        };
        // Of vectors, √3 times what it is of coordinates at most.
        let noise = NOISE.max(2.0 * (relative[1] + relative[2]));
        let normal = cross(&first, &second);
        let speed_squared = dot(&first, &first);
        let square = dot(&normal, &normal);
        if square.value() <= noise * noise * (speed_squared * dot(&second, &second)).value() {
            return Ok((0.0, noise));
        }
        let value = (square.sqrt() / (speed_squared * speed_squared.sqrt())).value();
        Ok((
            in_range(times_power(value, second_exponent - 2 * first_exponent))?,
            noise,
        ))
    }

    /// The torsion det(c', c'', c''') / |c' × c''|² of a curve in space, positive for a right-handed helix, from the given side where t is a knot.
    ///
    /// # Errors
    /// [`FloatError::Dimension`] in the plane; [`FloatError::Irregular`] where c' and c'' are parallel to 10⁻¹³ or to what rounding may do to them; otherwise as for [`Curve::curvature`].
    pub fn torsion(&self, t: f64, side: Side) -> Result<f64, FloatError> {
        if self.dimension != 3 {
            return Err(FloatError::Dimension);
        }
        Ok(self.torsion_and_noise(t, side)?.0)
    }

    /// The torsion, and the part of |c'''| / |c' × c''| that rounding of the derivatives may put in it.
    pub(super) fn torsion_and_noise(&self, t: f64, side: Side) -> Result<(f64, f64), FloatError> {
        let all = self.double_derivatives(t, side, 3)?;
        let relative = relative_errors(&self.derivative_errors(t, side, 3)?, &all)?;
        let (first, first_exponent) = unit_scaled(&all[1])?;
        let (second, second_exponent) = unit_scaled(&all[2])?;
        let normal = cross(&first, &second);
        let square = dot(&normal, &normal);
        let noise = 2.0 * (relative[1] + relative[2]);
        let sine = (square.value() / (dot(&first, &first) * dot(&second, &second)).value()).sqrt();
        if sine <= noise.max(PARALLEL) {
            return Err(FloatError::Irregular);
        }
        let Some((third, third_exponent)) = scaled(&all[3]) else {
            return Ok((0.0, NOISE));
        };
        let noise = NOISE.max(noise / sine + 2.0 * relative[3]);
        let determinant = dot(&normal, &third);
        if determinant.value().abs() <= noise * (square.value() * dot(&third, &third).value()).sqrt() {
            return Ok((0.0, noise));
        }
        let value = (determinant / square).value();
        let value = in_range(times_power(value, third_exponent - first_exponent - second_exponent))?;
        Ok((value, noise))
    }
}

/// Errors of derivatives relative to their lengths; [`FloatError::Irregular`] where c' is not known to 2⁻⁵³ of its length.
fn relative_errors(errors: &[f64], derivatives: &[[Double; 3]]) -> Result<[f64; 4], FloatError> {
    let mut relative = [0.0; 4];
    for (m, vector) in derivatives.iter().enumerate() {
        let size = vector.iter().fold(0.0, |most: f64, x| most.max(x.value().abs()));
        relative[m] = errors[m] / size;
    }
    // Not comparing true, NaN is refused.
    if relative[1] <= 0.5 * f64::EPSILON {
        Ok(relative)
    } else {
        Err(FloatError::Irregular)
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
