//! Exact curves: Bézier pieces, B-splines and NURBS with rational coordinates, knots and weights.
//!
//! The data types ([`Curve`], [`BSpline`], [`Bezier`], [`Chain`]) are plain data whose constructors refuse everything
//! that is not a curve; a value of these types is valid. Everything else works on them and is exact.

mod bezier;
mod blossom;
mod bspline;
mod chain;
mod data;
mod decompose;
mod derivative;
mod elevate;
mod error;
mod evaluate;
mod hodograph;
mod homogeneous;
mod insert;
mod joint;
mod operation;
mod periodic;
mod read;
mod split;
mod write;

pub use bezier::Bezier;
pub use bspline::BSpline;
pub use chain::{Chain, Piece};
pub use data::{Curve, Form};
pub use error::{CurveError, CurveFault};
pub use evaluate::{Side, bernstein};
pub use hodograph::Hodograph;
pub use joint::Joint;
pub use operation::OperationError;
pub use read::{
    CurveFile, MAXIMUM_TOTAL_BITS, Position, ReadError, ReadFault, ReadOptions, VERSION,
    read_curve, read_curve_with,
};
pub use write::write_curve;

/// The highest degree accepted.
pub const MAXIMUM_DEGREE: usize = 64;
/// The greatest number of Bézier pieces, or of control points of a B-spline, accepted.
pub const MAXIMUM_PIECES: usize = 4_000_000;
/// The greatest size in bits of a numerator or denominator accepted in a curve.
pub const MAXIMUM_BITS: u64 = 65_536;
