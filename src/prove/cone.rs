//! Circular cones of directions around the tangents of a node. Only for the search: what they exclude is replayed exactly.

use super::vector::{Vector, add, dot, scale, unit};

/// All directions within `angle` (radians) of `axis`.
#[derive(Clone, Copy, Debug)]
pub struct Cone {
    /// Unit axis.
    pub axis: Vector,
    /// Half-angle; π when nothing better is known.
    pub angle: f64,
}

/// Added to computed angles against rounding.
const SLACK: f64 = 1e-7;

impl Cone {
    /// Every direction.
    pub const FULL: Cone = Cone { axis: [1.0, 0.0, 0.0, 0.0], angle: std::f64::consts::PI };

    /// The cone around the sum of the directions, zero vectors left out.
    pub fn around(vectors: &[Vector]) -> Cone {
        let mut sum = [0.0; 4];
        for direction in vectors.iter().filter_map(unit) {
            sum = add(&sum, &direction);
        }
        let Some(axis) = unit(&sum) else { return Cone::FULL };
        let least = vectors.iter().filter_map(unit).map(|direction| dot(&direction, &axis)).fold(1.0, f64::min);
        Cone { axis, angle: least.clamp(-1.0, 1.0).acos() + SLACK }
    }

    /// A cone that holds both.
    pub fn merged(&self, other: &Cone) -> Cone {
        let between = dot(&self.axis, &other.axis).clamp(-1.0, 1.0).acos();
        if between + other.angle <= self.angle {
            return *self;
        }
        if between + self.angle <= other.angle {
            return *other;
        }
        let angle = (self.angle + other.angle + between) / 2.0 + SLACK;
        if angle >= std::f64::consts::PI || between < 1e-9 {
            return if angle >= std::f64::consts::PI { Cone::FULL } else { Cone { axis: self.axis, angle } };
        }
        // Turn this axis towards the other one by angle − self.angle.
        let turn = (angle - self.angle) / between;
        let (a, b) = (((1.0 - turn) * between).sin(), (turn * between).sin());
        match unit(&add(&scale(&self.axis, a), &scale(&other.axis, b))) {
            Some(axis) => Cone { axis, angle: angle + SLACK },
            None => Cone::FULL,
        }
    }

    /// Is x·v > 0 for every direction v in the cone?
    pub fn all_positive(&self, x: &Vector) -> bool {
        let along = dot(x, &self.axis);
        if self.angle >= 1.57 || along <= 0.0 {
            return false;
        }
        let square = dot(x, x);
        let across = (square - along * along).max(0.0).sqrt();
        along * self.angle.cos() > across * self.angle.sin() + 1e-9 * square.sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vectors() -> impl Strategy<Value = Vec<Vector>> {
        let direction = [-1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64];
        proptest::collection::vec(direction.prop_map(|[x, y, z]| [x, y, z, 0.0]), 1..5)
    }

    proptest! {
        #[test]
        fn merged_cones_hold_both(a in vectors(), b in vectors()) {
            let cone = Cone::around(&a).merged(&Cone::around(&b));
            for v in a.iter().chain(&b).filter_map(unit) {
                prop_assert!(dot(&v, &cone.axis).clamp(-1.0, 1.0).acos() <= cone.angle + 1e-6);
            }
        }

        #[test]
        fn positive_means_positive(a in vectors(), x in vectors()) {
            if Cone::around(&a).all_positive(&x[0]) {
                for v in &a {
                    prop_assert!(dot(v, &x[0]) >= 0.0);
                }
            }
        }
    }
}
