//! Exact spline geometry with certificates.
//!
//! ```text
//!  curve file ──→ exact curve ──→ search (binary64, untrusted) ──→ certificate ──→ checker (exact integers) ──→ verdict
//!  (JSON)         (rationals)     finds evidence                   statement +     replays, never searches
//!                                                                  evidence
//! ```
//!
//! A curve is a chain of polynomial or rational Bézier pieces, a B-spline or a NURBS curve in the plane or in space, its numbers exact
//! rationals ([`curve`]). A statement about it, such as "the minimum separation distance σ lies between these two fractions", is
//! written down together with evidence ([`claim`], [`certificate`]). Finding the evidence is the business of `prove`, of which nothing is
//! trusted; replaying it that of [`check`], which uses exact integers only. The formats are specified in `docs/FORMAT.md`, the statement and the proofs
//! of its rules are in `docs/msd.md`, and what an accepted certificate rests on is in `docs/TRUST.md`.
//!
//! Reading a curve, certifying its minimum separation distance, writing the certificate and checking it:
//!
//! ```
//! # #[cfg(feature = "prove")]
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! use knotproof::certificate::Encoding;
//! use knotproof::check::{Verdict, check};
//! use knotproof::curve::read_curve;
//! use knotproof::number::{sqrt_decimal_down, sqrt_decimal_up};
//! use knotproof::claim::msd::Lower;
//! use knotproof::prove::msd::{Options, certify};
//!
//! let file = read_curve(r#"{ "knotproof": "curve/1", "bspline": { "degree": 3,
//!     "knots": ["0", "0", "0", "0", "1/5", "2/5", "3/5", "4/5", "1", "1", "1", "1"],
//!     "points": [["0", "0", "0"], ["-1", "1", "0"], ["4.5", "5.5", "2"], ["5", "-1", "8.5"],
//!                ["-1.5", "2.5", "-4.5"], ["4.5", "6", "8.5"], ["3.5", "-3.5", "0"], ["0", "0", "0"]] } }"#)?;
//! let mut certified = certify(&file.curve, &Options::default(), &|_done| ())?;
//! let mut certificate = std::io::Cursor::new(Vec::new());
//! certified.write_checked(Encoding::Json, &mut certificate)?;
//!
//! let Verdict::Accepted { document, .. } = check(certificate.get_ref().as_slice()) else { panic!("not accepted") };
//! let statement = &document.claim.msd().expect("the claim that was made").statement;
//! let (Lower::Finite(lower), Some(upper)) = (&statement.lower_squared, &statement.upper_squared) else {
//!     panic!("bounds on both sides were expected")
//! };
//! assert_eq!(sqrt_decimal_down(lower, 11), "0.44267517037");
//! assert_eq!(sqrt_decimal_up(upper, 11), "0.44267517038");
//! # Ok(())
//! # }
//! # #[cfg(not(feature = "prove"))]
//! # fn main() {}
//! ```
#[cfg(feature = "prove")]
pub mod approximation;
pub mod certificate;
pub mod check;
pub mod claim;
#[cfg(feature = "prove")]
pub mod compare;
pub mod curve;
#[cfg(feature = "prove")]
pub mod engine;
#[cfg(feature = "prove")]
pub mod float;
#[cfg(feature = "import")]
pub mod import;
#[cfg(feature = "prove")]
pub mod motion;
pub mod number;
#[cfg(feature = "prove")]
pub mod polytope;
#[cfg(feature = "prove")]
pub mod prove;
#[cfg(feature = "prove")]
pub mod show;
#[cfg(feature = "prove")]
pub mod validate;
