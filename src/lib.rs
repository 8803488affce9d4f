//! Exact spline geometry with certificates.
pub mod certificate;
pub mod check;
pub mod claim;
pub mod curve;
pub mod number;
#[cfg(feature = "prove")]
pub mod prove;
