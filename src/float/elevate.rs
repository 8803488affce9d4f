//! Degree elevation.
//!
//! With the blossom f of a curve of degree q − 1, control point i of the curve elevated by one is the mean of f at the q arguments
//! τ_{i+1} … τ_{i+q} with one left out in turn (Ramshaw 1987). As every knot occurs once more than before, what is left is always a run of
//! consecutive knots of a refinement of the old knots, so that each value is a convex combination of old control points (Prautzsch and Piper 1991).
//! Pieces are not elevated one by one: to join them again knots would have to be removed, which loses digits where knots are close.

use super::curve::{Curve, Lifted, mix, parts};
use super::double::Double;
use super::error::FloatError;
use crate::curve::{MAXIMUM_DEGREE, MAXIMUM_PIECES};

impl Curve {
    /// The same curve with degree p + `times` and the same continuity: every knot of the domain occurs `times` times more.
    ///
    /// Knots outside the domain are repeated alike and the surplus at the two outer ends dropped.
    ///
    /// # Errors
    /// [`FloatError::Degree`] when the degree would exceed [`MAXIMUM_DEGREE`], [`FloatError::Argument`] when the control points would be too many.
    pub fn elevate_degree(&self, times: usize) -> Result<Curve, FloatError> {
        let degree = self.degree.saturating_add(times);
        if degree > MAXIMUM_DEGREE {
            return Err(FloatError::Degree { degree });
        }
        if self.knots.len().saturating_mul(times + 1) > MAXIMUM_PIECES {
            return Err(FloatError::Argument {
                expected: "at most 4,000,000 control points",
            });
        }
        if times == 0 {
            return Ok(self.clone());
        }
        let mut spline = Spline {
            degree: self.degree,
            knots: self.knots.clone(),
            control: self.lifted_range(0..self.count()),
        };
        for _ in 0..times {
            spline = spline.elevated();
        }
        self.with(spline.degree, spline.knots, &spline.control)
    }
}

/// A curve with its control points still in double-double.
struct Spline {
    degree: usize,
    knots: Vec<f64>,
    control: Vec<Lifted>,
}

impl Spline {
    /// The curve with one degree more.
    fn elevated(&self) -> Spline {
        let q = self.degree + 1;
        let knots = self.elevated_knots();
        let count = knots.len() - q - 1;
        let mut rest = Vec::with_capacity(q);
        let control = (0..count)
            .map(|i| {
                let arguments = &knots[i + 1..=i + q];
                let mut sum = [Double::ZERO; 4];
                let mut first = 0;
                for run in arguments.chunk_by(|a, b| a == b) {
                    rest.clear();
                    rest.extend_from_slice(&arguments[..first]);
                    rest.extend_from_slice(&arguments[first + 1..]);
                    let value = self.blossom(&rest);
                    for (x, y) in sum.iter_mut().zip(&value) {
                        *x = *x + y.times(run.len() as f64);
                    }
                    first += run.len();
                }
                let q = Double::from(q as f64);
                // The weight of a polynomial curve stays exactly 1: the runs add up to q.
                sum.map(|x| x / q)
            })
            .collect();
        Spline {
            degree: q,
            knots,
            control,
        }
    }

    /// Every distinct knot once more, trimmed so that the domain starts at index q and ends q knots before the last.
    fn elevated_knots(&self) -> Vec<f64> {
        let (p, n) = (self.degree, self.control.len());
        let mut all = Vec::with_capacity(2 * self.knots.len());
        for run in self.knots.chunk_by(|a, b| a == b) {
            all.extend_from_slice(run);
            all.push(run[0]);
        }
        let distinct = |range: &[f64]| range.chunk_by(|a, b| a == b).count();
        let first = distinct(&self.knots[..=p]) - 1;
        let last = distinct(&self.knots[n..]) - 1;
        all.truncate(all.len() - last);
        all.split_off(first)
    }

    /// f at p arguments in order that are consecutive knots of a refinement of the knots: those that are missing among the knots are inserted one after
    /// the other.
    fn blossom(&self, arguments: &[f64]) -> Lifted {
        let (p, n) = (self.degree, self.control.len());
        let at = |t: f64| {
            let first = self.knots.partition_point(|knot| *knot < t);
            let count = self.knots[first..].iter().take_while(|knot| **knot == t).count();
            (first, count)
        };
        // The arguments that are knots already form the run knots[run..run + p − missing].
        let mut missing: Vec<f64> = Vec::new();
        let mut run = None;
        let mut seen = 0;
        for group in arguments.chunk_by(|a, b| a == b) {
            let (first, count) = at(group[0]);
            let found = count.min(group.len());
            seen += group.len();
            if run.is_none() {
                // All copies but the last ones lie before; where all arguments are one knot at the end of the domain, its first copies count.
                let surplus = if seen == p && group[0] >= self.knots[n] {
                    0
                } else {
                    count - found
                };
                run = Some(first + surplus);
            }
            missing.extend(std::iter::repeat_n(group[0], group.len() - found));
        }
        let run = run.unwrap_or(1).clamp(1, n);
        let m = missing.len();
        let known = p - m;
        // With knots[run..] as the run, control point run − 1 − a has a further knots on the left and m − a on the right.
        let mut row: Vec<Lifted> = (0..=m)
            .map(|a| {
                let index = (run - 1 + a).saturating_sub(m).min(n - 1);
                self.control[index]
            })
            .collect();
        for (round, t) in missing.iter().enumerate() {
            let rest = m - 1 - round;
            for j in 0..=rest {
                // rest − j knots stay on the left and j on the right.
                let low = self.knots[(run + j).saturating_sub(rest + 1)];
                let high = self.knots[(run + known + j).min(self.knots.len() - 1)];
                if low < high {
                    let (u, v) = parts(low, *t, high);
                    row[j] = mix(v, &row[j], u, &row[j + 1]);
                }
            }
        }
        row[0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_known_elevation() {
        // A quadratic with one interior knot; its elevated points by hand (knots 0 0 0 0 1 1 2 2 2 2).
        let points = vec![0.0, 0.0, 1.0, 2.0, 3.0, 2.0, 4.0, 0.0];
        let curve = Curve::new(2, 2, vec![0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 2.0], points, None).unwrap();
        let elevated = curve.elevate_degree(1).unwrap();
        assert_eq!(elevated.knots(), [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0, 2.0]);
        // f(0,0) = (0,0), f(0,1) = (1,2), f(1,1) = (2,2), f(1,2) = (3,2), f(2,2) = (4,0).
        let expected = [
            0.0,
            0.0,
            2.0 / 3.0,
            4.0 / 3.0,
            4.0 / 3.0,
            2.0,
            8.0 / 3.0,
            2.0,
            10.0 / 3.0,
            4.0 / 3.0,
            4.0,
            0.0,
        ];
        assert_eq!(elevated.points(), expected);
    }
}
