//! Exact intersection of half-planes and half-spaces, and convex hulls by polarity.
//!
//! [`intersect`] takes rows n·x + c ≥ 0 with integer coefficients of any size, in the plane or in space, and tells exactly whether their
//! intersection is empty, flat, unbounded or a [`Polytope`] with interior: its vertices, its facets and their order, its area or volume.
//! [`Polytope::from_box`] and [`Polytope::clip`] build one row by row.
//!
//! Every decision is the sign of a row at a vertex. A vertex is kept as the rows that meet in it; its coordinates are known in binary64 and in
//! fixed-point numbers of 120 bits with proven error bounds, and as exact integers where these two leave a sign open.
//!
//! ```
//! use knotproof::number::{Integer, Rational};
//! use knotproof::polytope::{HalfSpace, Intersection, intersect};
//!
//! let row = |x: i32, y: i32, constant: i32| HalfSpace { normal: [x, y].map(Integer::from), constant: constant.into() };
//! // x ≥ 0, y ≥ 0, x + 2y ≤ 3, and x + y ≤ 7, which the others imply.
//! let rows = [row(1, 0, 0), row(0, 1, 0), row(-1, -2, 3), row(-1, -1, 7)];
//! let Intersection::Bounded(triangle) = intersect(&rows) else { panic!("a triangle was expected") };
//! assert_eq!(triangle.vertex_count(), 3);
//! assert_eq!(triangle.measure(), Rational::new(9.into(), 4.into()));
//! assert!(triangle.facets().all(|facet| facet.row != 3));
//! ```

mod body;
mod bounded;
mod duplicate;
mod enclosure;
mod fixed;
mod hull;
mod intersect;
mod measure;

mod scan;
mod vertex;

pub use bounded::{Facet, Polytope};
pub use hull::{HullError, hull2, hull3};
pub use intersect::intersect;

use crate::number::{Integer, Rational, RationalVector};

/// The points x with normal · x + constant ≥ 0, in the plane (D = 2) or in space (D = 3).
///
/// A zero normal is permitted: with a constant ≥ 0 all points, with a negative one none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HalfSpace<const D: usize> {
    /// Coefficients of the coordinates; the vector points inside.
    pub normal: [Integer; D],
    /// The value at the origin.
    pub constant: Integer,
}

static ZERO: Integer = Integer::ZERO;

impl<const D: usize> HalfSpace<D> {
    /// The half-space normal · x + constant ≥ 0 with rational coefficients, multiplied by their common denominator.
    pub fn from_rationals(normal: &[Rational; D], constant: &Rational) -> Self {
        let numbers: Vec<Rational> = normal.iter().chain([constant]).cloned().collect();
        let integers = RationalVector::from_rationals(&numbers);
        let integers = integers.numerators();
        HalfSpace {
            normal: std::array::from_fn(|i| integers[i].clone()),
            constant: integers[D].clone(),
        }
    }

    /// The value normal · x + constant.
    pub fn value(&self, point: &[Rational; D]) -> Rational {
        (0..D).fold(Rational::from_integer(self.constant.clone()), |sum, i| {
            sum + &point[i] * &self.normal[i]
        })
    }

    /// The coefficients as [`vertex::Row`] has them.
    fn coefficients(&self) -> [&Integer; 4] {
        const { assert!(D == 2 || D == 3, "the plane or space") }
        let third = if D == 2 { &ZERO } else { &self.normal[D - 1] };
        [&self.normal[0], &self.normal[1], third, &self.constant]
    }
}

/// The intersection of half-spaces.
#[derive(Clone, Debug)]
pub enum Intersection<const D: usize> {
    /// There is no point in it.
    Empty,
    /// Not empty, but without interior.
    Flat(Flat<D>),
    /// With interior, and of infinite extent.
    Unbounded,
    /// With interior, and bounded.
    Bounded(Polytope<D>),
}

/// What is known of an intersection without interior.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Flat<const D: usize> {
    /// Dimension of the affine hull: 0 for a point, 1 for part of a line, 2 for part of a plane.
    pub dimension: usize,
    /// A point of the relative interior. Where the intersection is unbounded, its coordinates can be very large.
    pub point: [Rational; D],
    /// Whether the intersection is bounded.
    pub bounded: bool,
}

/// What a half-space does to a polytope.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clip {
    /// It contains the polytope, which stays as it was.
    Redundant,
    /// It cut a part off and left one with interior.
    Cut,
    /// They have points in common, but no interior ones: a face of the polytope. The polytope was left as it was.
    Flat,
    /// They have no point in common. The polytope was left as it was.
    Empty,
}

#[cfg(test)]
mod tests;
