//! Curves in binary64: a fast engine whose results are accurate, but not proved.
//!
//! [`Curve`] holds binary64 numbers and takes them as exact. What a formula computes from them without search ([`Curve::derivative`],
//! [`Curve::insert_knot`], [`Curve::elevate_degree`] …) is computed in double-double arithmetic and rounded once; points of low degree are computed in
//! binary64 where that is safe. `docs/float.md` states method and measured error of every operation. What cannot be computed accurately is refused with a
//! [`FloatError`].
//!
//! ```
//! use knotproof::curve::Side;
//! use knotproof::float::Curve;
//!
//! // A cubic with an interior knot, whose two spans are elevated as one curve.
//! let curve = Curve::new(2, 3, vec![0.0, 0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0, 1.0],
//!     vec![0.0, 0.0, 1.0, 2.0, 2.0, -1.0, 3.0, 3.0, 4.0, 0.0], None)?;
//! assert_eq!(curve.point(0.25)?, [1.1875, 1.03125, 0.0]);
//! let elevated = curve.elevate_degree(1)?;
//! assert_eq!(elevated.point(0.25)?, [1.1875, 1.03125, 0.0]);
//! assert_eq!(curve.derivative(0.25, Side::After, 3)?, elevated.derivative(0.25, Side::After, 3)?);
//! # Ok::<(), knotproof::float::FloatError>(())
//! ```

mod bezier_evaluator;
mod bound;
mod cassidy;
mod convex_domain;
mod curvature;
mod curve;
mod decompose;
mod derivative;
mod distance;
mod double;
mod double_normal;
mod elevate;
mod error;
mod evaluator;
mod insert;
mod locate;
mod moore_peters;
mod nearest;
mod normals;
mod perturbation;
mod piece;
mod point;
mod remove;
mod separation;
mod solid;
mod span;
mod split;
mod starts;
mod taylor;
mod tree;

#[cfg(test)]
mod generate;
#[cfg(test)]
mod search_tests;
#[cfg(test)]
mod starts_tests;
#[cfg(test)]
mod tests;

pub use bezier_evaluator::BezierEvaluator;
pub use cassidy::Estimate;
pub use curve::Curve;
pub use derivative::MAXIMUM_ORDER;
pub use distance::Connection;
pub use error::FloatError;
pub use evaluator::Evaluator;
pub use moore_peters::{Comparison, DoublyNormalTest, Found};
pub use nearest::Nearest;
pub use perturbation::{Drift, MovingPolygon};
pub use separation::Separation;
pub use solid::ConvexSolid;
pub use starts::{DoubleNormals, Starts};
