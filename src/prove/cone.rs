//! Circular cones of directions around the tangents of a node. Only for the search: what they exclude is replayed exactly.

use smallvec::SmallVec;

use super::vector::{Vector, add, dot, lesser, scale, unit};

/// All directions within an angle of `axis`.
#[derive(Clone, Copy, Debug)]
pub struct Cone {
    /// Unit axis.
    pub axis: Vector,
    /// Cosine of the half-angle, rounded down; −1 when nothing better is known.
    pub cosine: f64,
}

/// Taken off computed cosines against rounding.
const SLACK: f64 = 1e-12;

impl Cone {
    /// Every direction.
    pub const FULL: Cone = Cone {
        axis: [1.0, 0.0, 0.0, 0.0],
        cosine: -1.0,
    };

    /// The cone around the sum of the directions, zero vectors left out.
    #[inline]
    pub fn around<'v>(vectors: impl Iterator<Item = &'v Vector>) -> Cone {
        let mut sum = [0.0; 4];
        let mut directions: SmallVec<[Vector; 8]> = SmallVec::new();
        for vector in vectors {
            if let Some(direction) = unit(vector) {
                sum = add(&sum, &direction);
                directions.push(direction);
            }
        }
        let Some(axis) = unit(&sum) else { return Cone::FULL };
        let cosines = directions.iter().map(|direction| dot(direction, &axis));
        Cone {
            axis,
            cosine: cosines.fold(1.0, |least, cosine| lesser(cosine, least)) - SLACK,
        }
    }

    /// A cone that holds both; [`Cone::FULL`] where that would be a half-space or more.
    pub fn merged(&self, other: &Cone) -> Cone {
        let between = dot(&self.axis, &other.axis);
        if self.cosine <= 0.0 || other.cosine <= 0.0 || between <= 0.0 {
            return Cone::FULL;
        }
        let (angle, other_angle) = (self.cosine.min(1.0).acos(), other.cosine.min(1.0).acos());
        let between = between.min(1.0).acos();
        if between + other_angle <= angle {
            return *self;
        }
        if between + angle <= other_angle {
            return *other;
        }
        let whole = (angle + other_angle + between) / 2.0 + 1e-9;
        if whole >= 1.5 || between < 1e-9 {
            return if whole >= 1.5 {
                Cone::FULL
            } else {
                Cone {
                    axis: self.axis,
                    cosine: (whole + between).cos() - SLACK,
                }
            };
        }
        // Turn this axis towards the other one by whole − angle.
        let turn = whole - angle;
        match unit(&add(
            &scale(&self.axis, (between - turn).sin()),
            &scale(&other.axis, turn.sin()),
        )) {
            Some(axis) => Cone {
                axis,
                cosine: (whole + 1e-9).cos() - SLACK,
            },
            None => Cone::FULL,
        }
    }

    /// Is x·v > 0 for every direction v in the cone?
    pub fn all_positive(&self, x: &Vector) -> bool {
        let along = dot(x, &self.axis);
        if self.cosine <= 0.0 || along <= 0.0 {
            return false;
        }
        // along·cos > across·sin, squared.
        let square = dot(x, x);
        let across = (square - along * along).max(0.0);
        let cosine_squared = self.cosine * self.cosine;
        along * along * cosine_squared > across * (1.0 - cosine_squared) + 1e-9 * square
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
            let cone = Cone::around(a.iter()).merged(&Cone::around(b.iter()));
            for v in a.iter().chain(&b).filter_map(unit) {
                prop_assert!(dot(&v, &cone.axis) >= cone.cosine - 1e-9);
            }
        }

        #[test]
        fn positive_means_positive(a in vectors(), x in vectors()) {
            if Cone::around(a.iter()).all_positive(&x[0]) {
                for v in &a {
                    prop_assert!(dot(v, &x[0]) >= 0.0);
                }
            }
        }
    }
}
