//! Points of a curve: de Boor's algorithm.

use super::curve::{Curve, Lifted, parts};
use super::double::Double;
use super::error::FloatError;
use crate::curve::{MAXIMUM_DEGREE, Side};

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
}
