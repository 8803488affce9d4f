//! Exact curves: Bézier pieces, B-splines and NURBS with rational coordinates, knots and weights.
//!
//! The data types ([`Curve`], [`BSpline`], [`Bezier`], [`Chain`]) are plain data whose constructors refuse everything
//! that is not a curve; a value of these types is valid. Everything else works on them and is exact.

mod bezier;
mod bspline;
mod chain;
mod data;
mod decompose;
mod error;
mod homogeneous;

pub use bezier::Bezier;
pub use bspline::BSpline;
pub use chain::{Chain, Piece};
pub use data::{Curve, Form};
pub use error::{CurveError, CurveFault};

/// The highest degree accepted.
pub const MAXIMUM_DEGREE: usize = 64;
/// The greatest number of Bézier pieces, or of control points of a B-spline, accepted.
pub const MAXIMUM_PIECES: usize = 4_000_000;
/// The greatest size in bits of a numerator or denominator accepted in a curve.
pub const MAXIMUM_BITS: u64 = 65_536;
