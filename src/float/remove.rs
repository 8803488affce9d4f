//! Knot removal (Tiller 1992).

use super::curve::{Curve, Lifted, mix, parts};
use super::double::Double;
use super::error::FloatError;

impl Curve {
    /// The curve without `times` copies of the knot `t`, strictly inside the domain, as long as it is the same curve up to `tolerance`.
    ///
    /// The new control points follow from the old ones from both sides, in double-double; where the two sides meet there is one equation too many, and
    /// its residual bounds how far the curve moves. `tolerance` is a distance; 0 asks for no change but rounding of the result. The residual of a knot
    /// that can be removed exactly is far below rounding of the control points, so anything up to a unit in the last place of the greatest coordinate
    /// is taken for 0.
    ///
    /// # Errors
    /// [`FloatError::OutsideDomain`]; [`FloatError::Multiplicity`] when `t` occurs less often; [`FloatError::NotRemovable`];
    /// [`FloatError::Range`] when a weight of the result would not be positive.
    pub fn remove_knot(&self, t: f64, times: usize, tolerance: f64) -> Result<Curve, FloatError> {
        let (start, end) = self.domain();
        if !(start < t && t < end) {
            return Err(FloatError::OutsideDomain);
        }
        let greatest = self.multiplicity(t);
        if times > greatest {
            let multiplicity = times;
            return Err(FloatError::Multiplicity { multiplicity, greatest });
        }
        if times == 0 {
            return Ok(self.clone());
        }
        let mut knots = self.knots.clone();
        let mut control = self.lifted_range(0..self.count());
        let mut deviation = 0.0;
        for _ in 0..times {
            let residual = remove(self.degree, &mut knots, &mut control, t);
            let least = control.iter().fold(f64::INFINITY, |least, c| least.min(c[3].value()));
            if least <= 0.0 || least.is_nan() {
                return Err(FloatError::Range { place: "result" });
            }
            // |X/w − X̃/w̃| ≤ (|X − X̃| + |c| |w − w̃|)/w.
            let point = residual[..3].iter().map(|x| x.value().powi(2)).sum::<f64>().sqrt();
            deviation += (point + 2.0 * self.magnitude() * residual[3].value().abs()) / least;
        }
        let rounding = f64::EPSILON * self.magnitude();
        if deviation > tolerance.max(rounding) || deviation.is_nan() {
            return Err(FloatError::NotRemovable { deviation });
        }
        self.with(self.degree, knots, &control)
    }
}

/// Removes one `t`; the residual of the equation left over.
fn remove(p: usize, knots: &mut Vec<f64>, control: &mut Vec<Lifted>, t: f64) -> Lifted {
    let after = knots.partition_point(|knot| *knot <= t);
    knots.remove(after - 1);
    // In the knots without it, t is inserted after index k with multiplicity s: old point i = (1 − α_i) new point i − 1 + α_i new point i for
    // first ≤ i ≤ last; before and after them old points are new ones.
    let k = after - 2;
    let s = knots[..=k].iter().rev().take_while(|knot| **knot == t).count();
    let (first, last) = (k + 1 - p, k - s);
    let alpha = |i: usize| parts(knots[i], t, knots[i + p]);
    // Error growth from the left up to new point i and from the right down to it; the equation left over is where their product is least.
    let growth_right = |i: usize| -> f64 { (i + 1..=last).map(|j| 1.0 / alpha(j).1.value()).product() };
    let mut meeting = first;
    let (mut from_left, mut least) = (1.0, f64::INFINITY);
    for i in first..=last {
        let growth = f64::max(from_left, growth_right(i));
        if growth < least {
            (least, meeting) = (growth, i);
        }
        from_left /= alpha(i).0.value();
    }
    let mut left = control[first - 1];
    let mut new_left = Vec::with_capacity(p);
    for i in first..meeting {
        let (u, v) = alpha(i);
        left = std::array::from_fn(|axis| (control[i][axis] - v * left[axis]) / u);
        new_left.push(left);
    }
    // Old point last + 1 is new point last.
    let mut right = control[last + 1];
    let mut new_right = Vec::with_capacity(p);
    for i in (meeting + 1..=last).rev() {
        let (u, v) = alpha(i);
        right = std::array::from_fn(|axis| (control[i][axis] - u * right[axis]) / v);
        new_right.push(right);
    }
    let (u, v) = alpha(meeting);
    let both = mix(v, &left, u, &right);
    let residual: [Double; 4] = std::array::from_fn(|axis| control[meeting][axis] - both[axis]);
    new_left.extend(new_right.into_iter().rev());
    control.splice(first..=last, new_left);
    residual
}
