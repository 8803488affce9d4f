//! Exact curves: Bézier pieces, B-splines and NURBS with rational coordinates, knots and weights.
//!
//! The data types ([`Curve`], [`BSpline`], [`Bezier`], [`Chain`]) are plain data whose constructors refuse everything
//! that is not a curve; a value of these types is valid. Everything else works on them and is exact.
//!
//! ```
//! use knotproof::curve::{Joint, read_curve};
//! use knotproof::number::{Integer, Rational};
//!
//! let json = r#"{ "knotproof": "curve/1",
//!     "bspline": { "degree": 2, "knots": [0, 0, 0, 1, 1, 2, 2, 2],
//!                  "points": [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0]], "weights": [1, 1, 2, 1, 1] } }"#;
//! let curve = read_curve(json)?.curve;
//! let chain = curve.chain();
//! assert_eq!(chain.count(), 2);
//! assert_eq!(chain.joint(1), Some(Joint::Smooth));
//! // The middle of the first quarter of the circle, in parameter: (3/5, 4/5).
//! let half = Rational::new(Integer::from(1), Integer::from(2));
//! let point = chain.evaluate(&half)?;
//! assert_eq!(&point[0] * &point[0] + &point[1] * &point[1], Rational::from_integer(Integer::from(1)));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

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
mod join;
mod joint;
mod operation;
mod periodic;
mod read;
mod remove;
mod split;
mod write;

pub use bezier::Bezier;
pub use bspline::BSpline;
pub use chain::{Chain, Piece};
pub use data::{Curve, Form};
pub use error::{CurveError, CurveFault};
pub use evaluate::{Side, bernstein};
pub use hodograph::Hodograph;
pub(crate) use join::align;
pub use joint::Joint;
pub use operation::OperationError;
#[cfg(feature = "prove")]
pub(crate) use read::read_number;
pub use read::{
    CurveFile, MAXIMUM_TOTAL_BITS, Position, ReadError, ReadFault, ReadOptions, VERSION, read_curve, read_curve_with,
};
pub use write::write_curve;

/// The highest degree accepted.
pub const MAXIMUM_DEGREE: usize = 64;
/// The greatest number of Bézier pieces, or of control points of a B-spline, accepted.
pub const MAXIMUM_PIECES: usize = 4_000_000;
/// The greatest size in bits of a numerator or denominator accepted in a curve.
pub const MAXIMUM_BITS: u64 = 65_536;
